# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-servo-compare: which laws arrive, how far the object strays in the image meanwhile, and the way there."""
import pathlib
import statistics

from .page import Cell, Page, counted, number
from .servo_figures import add_joints, add_motion, add_references, add_seeds, add_view, arm_law
from .servo_laws import Comparison, answers, findings, listed, shown
from .servo_step import add_shaped

# Heading, metric, which value is best: the least, the ideal one, none.
MAIN = [
    ("max (px)", "max_image_error_px", "least"),
    ("rms (px)", "rms_image_error_px", "least"),
    ("end (°)", "end_rotation_deg", "least"),
    ("left (°)", "left_end_rotation_deg", ""),
    ("expected (°)", "expected_end_rotation_deg", ""),
    ("yaw (°)", "yaw_range_deg", "ideal"),
    ("out (s)", "out_of_view_s", "least"),
]
FURTHER = [
    ("settle (s)", "settle_s", "least"),
    ("end (mm)", "end_translation_mm", "least"),
    ("left (mm)", "left_end_translation_mm", ""),
    ("expected (mm)", "expected_end_translation_mm", ""),
    ("path (m)", "path_length_m", ""),
    ("peak (m/s)", "peak_linear_mps", ""),
    ("peak (rad/s)", "peak_angular_radps", ""),
    ("rms jerk (m/s³)", "rms_linear_jerk_mps3", ""),
    ("peak jerk (m/s³)", "peak_linear_jerk_mps3", ""),
    ("losses", "view_losses", ""),
    ("above", "bounds_exceeded_cycles", ""),
]
PLANTS = [
    "plant = name; loop (Hz) = loop_rate_hz; vision (Hz) = vision_rate_hz; latency (ms) = 1000 latency_s; noise (px) = pixel_noise_px; "
    "lag (ms) = 1000 lag_s; friction (rad/s) = deadband_radps; limit (m/s) = max_linear_mps; limit (rad/s) = max_angular_radps"
]
THESIS_JOINT_RMS = [6.4, 8.6, 5.2, 12.5, 8.2, 8.5, 6.4]  # mrad, table 8.1


def cell_of(values, style=""):
    """The median, with the range in brackets."""
    if max(values) == float("inf"):
        return Cell("unknown", style)
    cell = Cell(float(statistics.median(values)), style)
    if min(values) != max(values):
        cell.text += f" [{number(min(values))}, {number(max(values))}]"
    return cell


def marks(c, medians, best):
    """Styles of a column by law: best and worst as displayed, unless too many laws share it. A yaw beyond the ideal is as wrong as one
    below."""
    bad = {law: abs(shown(m) - shown(c.ideal_yaw)) if best == "ideal" else shown(m) for law, m in medians.items()}
    least, most = min(bad.values()), max(bad.values())
    if not best or len(bad) < 2 or least == most:
        return {}
    shared = list(bad.values())
    words = {least: "best", most: "worst"}
    return {law: words[value] for law, value in bad.items() if value in words and 2 * shared.count(value) <= len(bad)}


def laws_rows(c, measure, columns):
    """A row for each plant and law, the hardest plant first."""
    for plant in reversed(c.plants):
        laws = [law for law in c.laws if c.runs(law, plant, measure)]
        medians = [{law: c.median(law, plant, metric, measure) for law in laws} for _, metric, _ in columns]
        styles = [marks(c, found, best) if found else {} for found, (*_, best) in zip(medians, columns)]
        for law in laws:
            cells = [cell_of(c.values(law, plant, metric, measure), style.get(law, "")) for (_, metric, _), style in zip(columns, styles)]
            yield [law, plant, c.look(law)[1], *cells]


def add_tables(page, c):
    seeds = f" Median and, in brackets, range over {c.summary['repetitions']} seeds." if c.summary["repetitions"] > 1 else ""
    header = lambda columns: ["law", "plant", "gain", *(title for title, *_ in columns)]  # noqa: E731
    for measure in c.measures:
        page.table(
            header(MAIN),
            laws_rows(c, measure, MAIN),
            f"Measured by {measure}. Max and rms: distance of the object's centre from its desired image position. End: largest true "
            "rotation error at the end of a segment; left: what the last measurement still shows of it, which the law has left; expected: "
            "root mean square of it by that measurement and its covariance. Yaw: range covered, ideal is "
            f"{number(c.ideal_yaw)}°. Out: time with a corner of the object out of the image. Green is the best of a plant, red the worst. "
            "Gain: that of the rotation near the goal; laws of one gain reduce the rotation error equally fast." + seeds,
        )
    for measure in c.measures:
        page.table(
            header(FURTHER),
            laws_rows(c, measure, FURTHER),
            f"Further figures, measured by {measure}. Settle: mean time of a segment until the error stays below 2° and 5 mm, its "
            "duration if never. End: largest translation error at the end of a segment. Speeds are those executed, jerks those of the "
            "command. Losses: how often a corner left the image. Above: cycles above a limit of the camera's motion, with --bounded."
            + seeds,
        )
    laws = ["law = id", "what it does = sentence"]
    page.records(c.summary["laws"], laws, "The same ids as in --law and summary.json.")


def margin_text(arm, joints):
    if "least_margin_joint" not in arm:
        return "no limits"
    joint, margin = arm["least_margin_joint"], max(0.0, arm["least_limit_margin"])
    slides = any(j["name"] == joint and j["type"] == "prismatic" for j in joints)
    return f"{number(1000 * margin)} mm ({joint})" if slides else f"{number(margin * 57.29577951)}° ({joint})"


def add_arm(page, c):
    page.paragraph(
        "The law's twist becomes joint velocities within all limits every 5 ms; where joints are to spare, what is left of them moves "
        "without moving the camera (self-motion). On plants with friction the drives follow by torques at 1 kHz: PD control with gravity, "
        "no friction compensation, friction that sticks. Masses, gains and friction of the AMOR arm are assumed, the thesis does not give them."
    )
    page.paragraph(
        "These drives (--drive measured) add the commanded velocity to the measured position, (3.18) of the thesis: a velocity too small "
        "for friction does not move a joint, and the law has to raise it. Drives that integrate in open loop (--drive integrated) hide "
        "friction from the law."
        if c.summary["robot"]["drive"] == "measured"
        else "These drives (--drive integrated) integrate the commanded velocity in open loop: a joint that sticks is pushed harder until it "
        "moves, and laws without an integral end about as near to the goal as those with one. This does not hold for drives that start "
        "from the measured position (--drive measured)."
    )
    arm = c.result.json("arm.json")
    first = [c.runs(law, plant)[0] for plant in c.plants for law in c.laws if c.runs(law, plant)]
    columns = [
        "law; plant",
        ("limit margin", lambda run: margin_text(run["arm"], arm["joints"])),
        "speed (%) = 100 arm.peak_velocity_share; acceleration (%) = 100 arm.peak_acceleration_share",
        ("worst joint rms (mrad)", lambda run: 1000 * max(run["arm"]["joint_rms"])),
        "least manipulability = arm.least_manipulability; self-motion (rad) = arm.self_motion_rad; slowed (s) = arm.limited_s; "
        "blocked (s) = arm.blocked_s; status = arm.status",
    ]
    page.records(
        first,
        columns,
        f"Measured by {c.measure}, first seed. Limit margin: least distance of a joint from a position limit, and which; 0: it was held "
        "there. Speed, acceleration: largest part of a joint's limit that was commanded; 100 is the limit itself, which is never exceeded. "
        "Self-motion: way the joints made for their own good. Slowed: less motion than asked for, by limits or near singularities; blocked: "
        "none. The status names a joint that did not follow or a drive at its limit, with the torque that is missing.",
    )
    law = arm_law(c)
    rows = [[f"plant {run['plant']}, {law}", *(1000 * rms for rms in run["arm"]["joint_rms"])] for run in first if run["law"] == law]
    if arm["name"] == "AMOR" and len(arm["joints"]) == len(THESIS_JOINT_RMS):
        rows.insert(0, ["thesis, table 8.1", *THESIS_JOINT_RMS])
    says = f"How well the joints follow their commands, with {law} (mm for sliding joints)."
    page.table(["joint rms (mrad)", *(joint["name"] for joint in arm["joints"])], rows, says)
    add_joints(page, c, arm)


def add_film(page, c):
    strip = c.summary["film_strip"]
    page.picture(
        c.result.bytes("film-strip.jpg"),
        "image/jpeg",
        "Rows of views, one for each law",
        f"Figure 5.11 again: the way to pose {c.segments[0]['name']} on plant {c.hard}; the last column is the end of the segment. Rows: "
        f"{listed(strip['laws'])}. Yellow: the object; blue: its desired position. A red frame: a corner is out of the view. In the thesis "
        "these are photographs by the robot's camera; here they are rendered.",
    )
    videos = c.summary["videos"]
    if not all(video["for_browsers"] for video in videos):
        codec = "This FFmpeg has no H.264 encoder: the videos are MPEG-4 part 2, which browsers do not play"
        page.paragraph(f"{codec}; open the files in video/ with a media player.")

    def caption(video):
        out = c.runs(video["law"], c.hard)[0]["out_of_view_s"]
        seen = f"object partly out of view for {number(out)} s" if out > 0 else "object always in view"
        end = number(c.runs(video["law"], c.hard)[0]["end_rotation_deg"])
        return f"{video['law']}, plant {c.hard}, {number(video['speed_up'])} times as fast: ends {end}° off, {seen}."

    page.videos([(c.result.beside(page.results[0], video["file"]), caption(video)) for video in videos])


def add_figures(page, c):
    page.paragraph("Numbered as in the thesis where they repeat one of its figures. A law has the same colour everywhere.")
    add_references(page, c)
    add_motion(page, c)
    if c.summary["repetitions"] > 1:
        add_seeds(page, c)


def route_of(task):
    """Names of the poses in visiting order: "1 - 2 - 1 - 3" for the task of the thesis."""
    names = [segment["name"] for segment in task["segments"]]
    keys = ("position_m", "rotation_deg")
    at_start = [s["name"] for s in task["segments"] if all(abs(a - b) < 1e-4 for key in keys for a, b in zip(s[key], task["start"][key]))]
    return " – ".join([at_start[-1] if at_start else "start", *names])


def add_what(page, c):
    s, task = c.summary, c.summary["task"]
    duration = sum(segment["duration_s"] for segment in c.segments)
    page.paragraph(
        f"A camera on a robot looks at a flat object and visits the poses {route_of(task)} one after another, {number(duration)} s in all. "
        f"{counted(len(c.laws), 'law')} on {counted(len(c.plants), 'plant')} (simulated robots), {counted(len(s['runs']), 'run')}; every law has "
        "the same task, gains, limits, latency and noise"
        + (f", and {s['repetitions']} seeds. Numbers are medians." if s["repetitions"] > 1 else ", and the same seed.")
    )
    page.paragraph(
        "“The thesis” is “Direct Methods for Vision-Based Robot Control”, whose section 5.4 compares PBVS, Kyrki's law and its own on a real "
        "robot with friction; its figures are repeated here as far as the laws were run."
    )
    if s["description"]:
        page.paragraph(s["description"])
    carried = [f"The camera is in the hand of an arm: {s['robot']['sentence']}"] if c.on_arm else []
    page.items(*carried, *(f"Plant {name}: {plant['sentence']}" for name, plant in c.plants.items()))
    page.paragraph(
        "Simulated and real: the robots, their friction and latency and all motions are simulated. The picture on the object is a real "
        f"photograph ({pathlib.PurePath(s['target']).name}). Every view of it is rendered from that photograph; no picture here was taken by "
        "a robot's camera. By “points” a law gets the object's feature points with noise, through a homography; by “image” it gets what the "
        "vision of visp-direct measures in rendered views."
    )


def pose_text(pose):
    position, rotation = (", ".join(number(round(x, 9)) for x in pose[key]) for key in ("position_m", "rotation_deg"))
    return f"position ({position}) m, rotation ({rotation})°"


def add_parameters(page, c):
    s, task, gains, faults = c.summary, c.summary["task"], c.summary["gains"], c.summary["image_faults"]
    camera, thing = task["camera"], task["object"]
    poses = [(f"pose {p['name']}, object in the camera, {number(p['duration_s'])} s", pose_text(p)) for p in c.segments]
    first = [("task", f"{task['name']}: {route_of(task)}"), ("start, object in the camera", pose_text(task["start"])), *poses]
    first += [("robot", s["robot"]["sentence"])] if c.on_arm else []
    seeds = f"{s['seed']} to {s['seed'] + s['repetitions'] - 1}; figures, videos and logs show the first, any other is repeated with --seed"
    facts = {
        "camera": f"f = ({number(camera['px'])}, {number(camera['py'])}) px, centre ({number(camera['u0'])}, {number(camera['v0'])}) px, "
        f"{camera['width']} × {camera['height']} px, no distortion",
        "object": f"{number(1000 * thing['width_m'])} × {number(1000 * thing['height_m'])} mm, {thing['points']} feature points; how soon it leaves "
        "the view depends on this size, which the thesis does not give",
        "photo (real)": s["target"] + (f". {s['target_remark']}" if s["target_remark"] else ""),
        "rendered views for measure image": f"grey noise {number(faults['noise'])}, blur {number(faults['blur_px'])} px, gain {number(faults['gain'])}, bias "
        f"{number(faults['bias'])}, occlusion {number(faults['occlusion'])}; ideal on plants without pixel noise",
        "gains, the same for every law": f"lambda {number(gains['lambda'])} 1/s, rotation factor {number(gains['rotation'])}, kappa {number(gains['kappa'])}, saturation "
        f"{number(gains['saturation_rad'])} rad, integral {number(gains['integral'])} 1/s² up to {number(gains['integral_limit_radps'])} "
        "rad/s; laws with -rot2 and ff-lookat have twice the rotation gain built in",
        "seed": seeds if s["repetitions"] > 1 else str(s["seed"]),
        "program": f"visp-servo-compare {s['version']}, ViSP {s['visp_version']}",
        "command": s["command_line"],
        "wall time": f"{number(s['wall_time_s'])} s",
    }
    page.facts([*first, *facts.items()], "Rotations are theta u; frames as in ViSP: z along the optical axis, x right, y down.")
    arm = "On an arm lag and friction come from its joints: friction 0.1 stands for that of the arm's file, 0.2 for twice that."
    friction = arm if c.on_arm else "Friction is seen as a velocity that each rotation axis loses."
    page.records(s["plants"], PLANTS, f"The plants. {friction} Limits scale the whole twist.")
    page.paragraph("Beside this page: summary.json (all figures of all runs), log/ (one CSV file for each run), video/ (the films).")


SECTIONS = [  # title, what adds its contents, a field of Comparison that must be true
    ("What else came out", lambda page, c: page.items(*findings(c)), "laws"),
    ("The way there", add_view, "laws"),
    ("Laws and plants", add_tables, "laws"),
    ("Figures", add_figures, "laws"),
    ("The arm", add_arm, "on_arm"),
    ("The step at the start", add_shaped, "shaped"),
    ("What the camera sees", add_film, "laws"),
    ("What was run", add_what, "laws"),
    ("Parameters of every run", add_parameters, "laws"),
]


def page(results):
    comparisons = [Comparison(result) for result in results]
    lead = "; ".join(f"{c.result.name}: {counted(len(c.laws), 'law')} on {c.summary['task']['name']}" for c in comparisons) + "."
    page = Page("Visual servoing laws compared", lead, results)
    for c in comparisons:
        page.answers(*answers(c), of=c.result)
    for title, add, field in SECTIONS:
        for c in comparisons:
            if getattr(c, field):
                page.section(title, c.result)
                add(page, c)
    return page
