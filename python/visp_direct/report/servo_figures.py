# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of visp-servo-compare: 5.6 to 5.10 of the thesis again, the camera's path, the seeds, the joints, and the 3D view."""
import math

import numpy as np

from .camera3d import NO_ARM, Z_UP, camera, chosen, columns, matrices, outline, photograph, plate
from .page import number
from .plots import colour, figure, legend_above, plain
from .servo_laws import is_filtered
from .view3d import arm_of, base_at, beside, scene

POINTS = 600  # of a curve; more would not be visible
RAW, SHAPED = "#d62728", "#1f77b4"
DEGREES = 180 / math.pi


def column(log, name):
    return np.asarray(log[name], float)


def stride(count):
    return slice(None, None, max(1, count // POINTS))


def ends(c):
    """When the segments end, s."""
    return np.cumsum([segment["duration_s"] for segment in c.segments])


def segment_marks(axes, c, last):
    for segment, end in list(zip(c.segments, ends(c)))[:last]:
        start = end - segment["duration_s"]
        axes.axvline(start, color="#999999", linewidth=0.9)
        place = {"xy": (start, 1), "xycoords": ("data", "axes fraction"), "xytext": (3, -9), "textcoords": "offset points"}
        axes.annotate(f"to pose {plain(segment['name'])}", fontsize=7, color="#666666", **place)
    axes.set(xlim=(0, ends(c)[last - 1]), xlabel="time (s)")


def curves(axes, c, plant, laws, value, until=math.inf, **style):
    for law in laws:
        log = c.log(law, plant)
        if log:
            t = column(log, "time_s")
            part = stride(len(t))
            inside = t[part] <= until
            dashed = {"linestyle": "--"} if is_filtered(law) else {}
            axes.plot(t[part][inside], value(log)[part][inside], color=c.look(law)[0], **{"label": plain(law)} | dashed | style)


def goal(axes, c, plant, laws):
    log = c.log(laws[0], plant)
    if log:
        axes.plot(log["time_s"], DEGREES * column(log, "goal_yaw_rad"), ":", color="#555555", linewidth=1.2, label="goal")


@figure(height=3)
def over_time(axes, c, plant, laws, label, value, with_goal=False, last=None, thin=None):
    """A value of the logs. thin: a second value, of thin curves."""
    last = last or len(c.segments)
    until = ends(c)[last - 1]
    curves(axes, c, plant, laws, value, until, **({"linewidth": 2.2} if thin else {}))
    if thin:
        curves(axes, c, plant, laws, thin, until, linewidth=0.7, label=None)
    if with_goal:
        goal(axes, c, plant, laws)
    axes.margins(y=0.12)  # room for the names of the segments
    segment_marks(axes, c, last)
    legend_above(axes, 5, ylabel=label)


def degrees(name):
    return lambda log: DEGREES * column(log, name)


def overshoot(c, law, plant):
    """How far a law's reference goes beyond the goal of a segment, deg."""
    log = c.log(law, plant)
    aim, reference = column(log, "goal_yaw_rad"), column(log, "reference_yaw_rad")
    begins = [0, *(np.flatnonzero(np.diff(aim)) + 1), len(aim)]
    former = np.concatenate([np.full(end - begin, aim[begin - 1] if begin else 0.0) for begin, end in zip(begins, begins[1:])])
    return DEGREES * max(0.0, float(np.max(np.where(aim >= former, 1, -1) * (reference - aim))))


def said(laws, *notes):
    """Those sentences whose laws are in the figure: laws with blanks between, a sentence or a function of it, and so on."""
    pairs = zip(notes[::2], notes[1::2])
    return "".join(" " + (text() if callable(text) else text) for needed, text in pairs if set(needed.split()) <= set(laws))


def add_references(page, c):
    laws = c.preferred("pbvs1", "ff-sum", "ff-lookat")
    drawn = over_time(c, c.easy, laws, "reference yaw (°)", degrees("reference_yaw_rad"), True)
    page.figure(
        drawn.named("figure-5.6", f"Reference yaw on plant {c.easy}"),
        f"Figure 5.6 again, on plant {c.easy}: the yaw that a law aims at, where its angular velocity would lead if it decayed as its "
        "rotation error does."
        + said(
            laws,
            "pbvs1",
            "pbvs1 aims at the goal from the first instant, a constant.",
            "ff-sum",
            lambda: "ff-sum goes beyond the goal while the object is off its place in the image, by at most "
            f"{number(overshoot(c, 'ff-sum', c.easy))}° here; in the thesis the overshoot is plain to see.",
            "ff-lookat",
            "ff-lookat, which is not in the thesis, turns no faster than the translation asks for, so its reference reaches the "
            "goal later.",
        ),
    )
    laws = c.preferred("pbvs1", "kyrki", "kyrki-decoupled", "ff-sum", "ff-lookat")
    drawn = over_time(c, c.easy, laws, "goal yaw − yaw (°)", lambda log: degrees("goal_yaw_rad")(log) - degrees("yaw_rad")(log))
    page.figure(
        drawn.named("figure-5.7", f"Yaw error on plant {c.easy}"),
        f"Figure 5.7 again, on plant {c.easy}: how far the camera still has to turn. Laws whose curves lie on each other turn equally "
        "fast; what differs is where the object is in the image meanwhile, at worst, px: "
        f"{c.per_law(laws, c.easy, 'max_image_error_px')}."
        + said(
            laws,
            "kyrki kyrki-decoupled",
            "The thesis shows one curve for Kyrki; here kyrki, the full law, and kyrki-decoupled, which the thesis uses, are separate.",
        ),
    )
    laws = c.preferred("pbvs1", "kyrki", "kyrki-decoupled", "ff-sum", "ff-lookat-pi")
    drawn = over_time(c, c.hard, laws, "reference yaw (°)", degrees("reference_yaw_rad"), True)
    page.figure(
        drawn.named("figure-5.8", f"Reference yaw on plant {c.hard}"),
        f"Figure 5.8 again: the same on plant {c.hard}. Where friction stops the camera before the goal, an image error remains."
        + said(
            laws,
            "ff-sum",
            lambda: "It keeps the feedforward term of ff-sum alive: its reference goes up to "
            f"{number(overshoot(c, 'ff-sum', c.hard))}° beyond the goal, which the thesis shows too.",
            "ff-lookat-pi",
            "The reference of ff-lookat-pi rises with its integral until the camera turns.",
            "kyrki-decoupled",
            "That of kyrki-decoupled, the law of the thesis, follows from the image error alone.",
        ),
    )


def add_motion(page, c):
    laws = c.preferred("kyrki", "kyrki-decoupled", "ff-sum", "ff-lookat-pi")
    drawn = over_time(c, c.hard, laws, "yaw (°)", degrees("yaw_rad"), True, thin=degrees("reference_yaw_rad"))
    page.figure(
        drawn.named("figure-5.9", f"Yaw and its reference on plant {c.hard}"),
        f"Figure 5.9 again, on plant {c.hard}: where each law wants to turn to (thin) and how the camera turns (thick). The camera moves "
        "smoothly although vision is slow. The range of yaw is what the thesis calls exploration: of "
        f"{number(c.ideal_yaw)}° between the goals, the laws reach, °: {c.per_law(laws, c.hard, 'yaw_range_deg')}. In the thesis the "
        "references are steps because vision alone updates them; here odometry fills in between frames.",
    )
    laws = c.preferred("pbvs1", "kyrki", "kyrki-decoupled", "ff-sum", "ff-lookat-pi")
    page.figure(
        over_time(
            c,
            c.hard,
            laws,
            "u of the object's centre − goal (px)",
            lambda log: column(log, "image_error_u_px"),
            last=min(2, len(c.segments)),
        ).named("figure-5.10", f"Image error on plant {c.hard}"),
        f"Figure 5.10 again, on plant {c.hard}: how far the object is from its desired image position, to the right positive, for the "
        "first two segments (1-2-1 in the thesis). A curve that ends a segment level but away from zero is held by friction. Root mean "
        f"square over the whole task, px: {c.per_law(laws, c.hard, 'rms_image_error_px')}."
        + said(laws, "kyrki kyrki-decoupled", "The large error of Kyrki in the thesis is that of the decoupled law."),
    )
    page.figure(
        path_figure(c, laws).named("path", f"The camera's path from above on plant {c.hard}"),
        f"The camera's way from above on plant {c.hard} (thick, from (0, 0)) and, thin in the same colour, where it looks when a segment "
        "ends; dashed, where it should look. A camera that friction keeps from turning to the end looks past the centre of the object. "
        f"Length of the way, m: {c.per_law(laws, c.hard, 'path_length_m')}. The thesis has no such figure.",
    )


def pose_of(item):
    return matrices([item["position_m"]], np.radians([item["rotation_deg"]]))[0]


def poses_of(log, index=slice(None)):
    """Poses of the camera in the world, its first frame."""
    return columns(log, kinds=("tx_m", "ty_m", "tz_m", "tux_rad", "tuy_rad", "tuz_rad"))[index]


@figure(height=4.4)
def path_figure(axes, c, laws):
    task = c.summary["task"]
    start = pose_of(task["start"])

    def gaze(wMc, length, **style):
        p = np.stack([wMc[:3, 3], wMc[:3, 3] + length * wMc[:3, 2]])
        axes.plot(p[:, 0], p[:, 2], **style)

    for law in laws:
        log = c.log(law, c.hard)
        if not log:
            continue
        part, paint = stride(len(log["time_s"])), c.look(law)[0]
        axes.plot(column(log, "tx_m")[part], column(log, "tz_m")[part], color=paint, linewidth=2.2, label=plain(law))
        last = np.searchsorted(column(log, "time_s"), ends(c) - 1e-9) - 1
        for wMc in poses_of(log, last):
            gaze(wMc, float(np.linalg.norm(start[:3, 3] - wMc[:3, 3])), color=paint, linewidth=0.8)
    for i, segment in enumerate(c.segments):
        cdMo = pose_of(segment)
        dashed = {"color": "#888888", "linestyle": "--", "linewidth": 1, "label": None if i else "where goals look"}
        gaze(start @ np.linalg.inv(cdMo), cdMo[2, 3], **dashed)
    sides = start @ np.array([[s * task["object"]["width_m"] / 2, 0, 0, 1] for s in (-1, 1)]).T
    axes.plot(sides[0], sides[2], color="#111111", linewidth=4, solid_capstyle="butt", label="object")
    legend_above(axes, 4, xlabel="to the right (m)", ylabel="towards the object (m)", aspect="equal")


@figure(height=3.6)
def seeds_figure(axes, c, metric, label):
    """One dot per seed above each law."""
    for i, law in enumerate(c.laws):
        values = np.array(c.values(law, c.hard, metric))
        spread = 0.36 * (np.mod(0.618 * np.arange(len(values)), 1) - 0.5)  # so that equal values do not hide each other
        axes.plot(i + spread, values, ".", color=c.look(law)[0], markersize=5)
    axes.set_xticks(range(len(c.laws)), [plain(law) for law in c.laws], rotation=35, ha="right", fontsize=8)
    axes.set(ylabel=label, ylim=(0, None), xlim=(-0.6, len(c.laws) - 0.4))


def add_seeds(page, c):
    caption = "One dot for each seed (noise and feature points differ); left to right within a law means nothing."
    for metric, what, label in (
        ("end_rotation_deg", "Rotation error at the end of the segments", "°"),
        ("rms_image_error_px", "Root mean square of the image error", "px"),
    ):
        title = f"{what} on plant {c.hard}, {c.summary['repetitions']} seeds"
        page.figure(seeds_figure(c, metric, f"{what.lower()} ({label})").named(f"seeds-{metric}", title), f"{title}. {caption}")


def arm_law(c):
    return "ff-lookat-pi" if "ff-lookat-pi" in c.laws else c.laws[0]


def joint_columns(log, quantity):
    return np.array([column(log, name) for name in log if name.startswith(quantity + "_")])


def each_joint(axes, joints, t, values, which, label):
    part = stride(len(t))
    for i in which:
        line, name = "-" if i < 7 else "--", plain(joints[i]["name"])
        axes.plot(t[part], values[i][part], color=colour(i), linestyle=line, linewidth=1.1, label=name)
    axes.set_ylabel(label)


@figure(4, 1.7)
def joints_figure(panels, joints, log):
    unit = np.array([1000 if joint["type"] == "prismatic" else DEGREES for joint in joints])[:, None]
    t, q, command = np.asarray(log["time_s"]), joint_columns(log, "q"), joint_columns(log, "command")
    speeds = np.array([math.inf if joint["velocity"] is None else joint["velocity"] for joint in joints])[:, None]
    part, everyone = stride(len(t)), range(len(joints))
    limited = [i for i in everyone if joints[i]["limits"]]
    each_joint(panels[0], joints, t, unit * q, everyone, "joints (°, mm)")
    each_joint(panels[1], joints, t, 100 * command / speeds, everyone, "speed (% of limit)")
    margins = np.array([np.minimum(q[i] - joints[i]["limits"][0], joints[i]["limits"][1] - q[i]) if i in limited else t for i in everyone])
    each_joint(panels[2], joints, t, unit * margins, limited, "to the limit (°, mm)")
    panels[3].plot(t[part], column(log, "self_motion_radps")[part], color=SHAPED, label="self-motion (rad/s)")
    panels[3].plot(t[part], 10 * column(log, "manipulability")[part], color=RAW, label="manipulability × 10")
    for axes in panels[2:]:
        axes.set_ylim(bottom=0)
    legend_above(panels[0], 8)
    legend_above(panels[3], 2, xlabel="time (s)", xlim=(0, t[-1]))


@figure(height=3)
def errors_figure(axes, joints, log):
    t, errors = np.asarray(log["time_s"]), 1000 * (joint_columns(log, "wanted") - joint_columns(log, "q"))
    each_joint(axes, joints, t, errors, range(len(joints)), "wanted − true (mrad, mm)")
    legend_above(axes, 8, xlabel="time (s)", xlim=(0, t[-1]))


def add_joints(page, c, arm):
    law = arm_law(c)
    log = c.log(law, c.hard)
    where = f"{law} on plant {c.hard}"
    page.figure(
        joints_figure(arm["joints"], log).named("arm-joints", f"The joints: {where}"),
        f"{where}. From top to bottom: the joints; how much of their speed limits they use; how far the limited ones are from their nearer "
        "limit; self-motion, which turns joints without moving the camera, and the manipulability √det(J Jᵀ), 0 in a singularity.",
    )
    if max(c.runs(law, c.hard)[0]["arm"]["joint_rms"]) > 0:
        page.figure(
            errors_figure(arm["joints"], log).named("arm-errors", f"Joint errors: {where}"),
            f"{where}: commanded minus true joints. PD control with gravity; a joint that sticks keeps an error up to its friction over "
            "its gain.",
        )


def add_view(page, c):
    """All laws on the hardest plant, one on each side."""
    task, size = c.summary["task"], [c.summary["task"]["object"][key] for key in ("width_m", "height_m")]
    start = pose_of(task["start"])
    world = np.array(c.summary["robot"]["camera_at_start"]) if c.on_arm else Z_UP
    arm, missing = arm_of(c.result.json("arm.json"), c.result.folder) if c.on_arm else (NO_ARM, [])
    begins = [0.0, *ends(c)[:-1].tolist()]
    goals = [[begin, outline(pose_of(segment), size)] for begin, segment in zip(begins, c.segments)]
    runs = []
    for law in c.laws:
        log = c.log(law, c.hard)
        if log:
            index = chosen(len(log["time_s"]))
            ended = np.maximum(index - 1, 0)  # joints are those at the end of a row's cycle
            q = joint_columns(log, "q")[:, ended].T.round(4).tolist() if c.on_arm else [[] for _ in index]
            poses = world @ poses_of(log, index)
            run = {"name": law, "colour": c.look(law)[0], "arm": 0, "t": column(log, "time_s")[index].round(4).tolist(), "q": q}
            runs.append(run | {"camera": camera(task["camera"], poses, 0.3 * start[2, 3], goals)})
    names = [run["name"] for run in runs]
    first = [names.index(law) for law in ("pbvs1", "ff-lookat-pi") if law in names]
    first = first if len(first) == 2 else list(range(min(2, len(runs))))
    sides = [np.eye(4), np.array(base_at(beside(1.4 if c.on_arm else 0.8)))][: len(first)]
    picture = photograph(c.result.bytes("target.png"))
    plates = [plate(size, base @ world @ start, picture) for base in sides]
    shown = scene([arm], runs, plates, sides=[{"base": base.tolist(), "run": run} for base, run in zip(sides, first)])
    page.view(
        shown,
        f"Plant {c.hard}. "
        + ("Choose a law for each side; the" if len(first) > 1 else "The")
        + " slider moves time. In the corners, and in front of each camera: the image that it sees, rendered here from the photograph; "
        "blue: where the object should be. The grid has squares of 10 cm. Drag to turn, the wheel or two fingers to zoom.",
    )
    page.items(*missing)
