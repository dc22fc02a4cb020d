# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-servo: how the run ended, its motion, what the camera saw, and its times; and of --replay."""
import numpy as np
from matplotlib import ticker

from .camera3d import NO_ARM, Z_UP, camera, chosen, columns, outline, photograph, plate
from .page import Page, number
from .plots import COLOURS, Figure, figure, legend_above
from .servo_laws import listed
from .view3d import arm_of, base_at, beside, scene

ROWS = 4000  # of a log in figures
SHORTEST = 1e-3  # ms, in the figure of times
MOST_EVENTS = 40
DEGREES = 180 / np.pi
OTHER_SIDE = 1.2  # m, between results side by side


def norm(log, prefix, names):
    return np.sqrt(sum(np.square(log[prefix + name]) for name in names))


LINEAR, ANGULAR = ("x", "y", "z"), ("wx", "wy", "wz")


def panels_figure(t, panels):
    """Panels from top to bottom: label, curves (values, colour, name or None), limit or None. All from zero."""

    def draw(axes):
        for one, (label, curves, limit) in zip(axes, panels):
            for values, paint, name in curves:
                one.plot(t, values, color=paint, linewidth=1.1, label=name)
            if limit is not None:
                one.axhline(limit, color="#555555", linestyle="--", linewidth=1, label="limit")
            one.set(ylabel=label, ylim=(0, None))
        axes[-1].set(xlabel="time (s)", xlim=(t[0], t[-1]))
        legend_above(axes[0])

    return Figure(draw, len(panels), 1.9)


def add_motion(page, log, settings):
    what = "camera" if "fMc_tx" in log else "end effector"  # which moves
    t = np.array(log["time_s"])
    if len(t) < 2:
        return
    distance, angle = np.array(log["position_error_m"]), np.array(log["rotation_error_rad"])
    if np.isfinite(distance).any():
        panels = [
            ("distance from goal (mm)", [(1e3 * distance, COLOURS[0], None)], None),
            ("angle (°)", [(DEGREES * angle, COLOURS[1], None)], None),
        ]
        page.figure(
            panels_figure(t, panels).named("errors", "Distance and angle from the goal over time"),
            "Distance and angle from the goal, from the last image, carried on to each cycle by the motion of the robot since its capture. A "
            "gap: the target was not seen.",
        )
    linear, angular = norm(log, "v_", LINEAR), norm(log, "v_", ANGULAR)
    panels = [
        ("speed (mm/s)", [(1e3 * linear, COLOURS[0], None)], 1e3 * settings["linear_velocity_mps"]),
        ("angular speed (°/s)", [(DEGREES * angular, COLOURS[1], None)], DEGREES * settings["angular_velocity_radps"]),
    ]
    page.figure(
        panels_figure(t, panels).named("speeds", f"Commanded speed of the {what} over time"),
        f"Speed of the {what} as it was given to the robot, within the limits.",
    )


def stairs(histogram):
    """Edges (ms) and shares (%) without gaps: empty bins are not in the data."""
    edges, shares, total = [max(histogram[0][0], 1e-4)], [], sum(count for *_, count in histogram)
    for start, end, count in histogram:
        if start > edges[-1] * 1.001:
            edges.append(start)
            shares.append(0)
        edges.append(end)
        shares.append(100 * count / total)
    return edges, shares


@figure(height=3)
def times_figure(axes, times):
    drawn = [(name, time) for name, time in times.items() if time["max_ms"] > SHORTEST]
    for (name, time), paint in zip(drawn, COLOURS):
        edges, shares = stairs(time["histogram"])
        axes.stairs(shares, edges, color=paint, linewidth=1.3, label=name.replace("_", " "))
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda x, _: number(float(x))))
    axes.set(xlabel="ms", ylabel="share (%)", ylim=(0, None))
    axes.set_xlim(left=max(SHORTEST, axes.get_xlim()[0]))
    legend_above(axes, 6)


TIMES = [
    ("", "sentence"),
    ("in the figure", lambda time: time["name"].replace("_", " ")),
    "number = count; median (ms) = median_ms; 99 % (ms) = p99_ms; largest (ms) = max_ms",
]


def add_times(page, summary):
    times = summary["times"]
    page.records([{"name": name, **time} for name, time in times.items()], TIMES, "Quantiles are exact to 5 %.")
    if times:
        page.figure(
            times_figure(times).named("times", "Histograms of the times"),
            "How often each duration occurred, on a logarithmic axis. A narrow peak is a steady clock.",
        )
    page.paragraph(
        f"{summary['real_time']} doc/real-time.md helps."
        if summary["real_time"]
        else "This run went as fast as the machine can: latency, periods and jitter are those of the simulated or recorded clock; only the "
        "computing times are real. --real-time measures them all."
    )


def add_events(page, result):
    events = result.table("events.csv")
    rows, said = list(zip(events["time_s"], events["status"], events["message"])), "Every change of status."
    if len(rows) > MOST_EVENTS:
        said = f"The first {MOST_EVENTS} of {len(rows)} changes; all are in events.csv."
    page.table(["time (s)", "status", "message"], rows[:MOST_EVENTS], said)


def seen_target(log, index, fMc, cMo, world, scene_data, picture):
    """The target as it was seen, a plate; none without a pose."""
    seen = [k for k in range(len(index)) if np.isfinite(cMo[k]).all()]
    if not seen:
        return []
    size = scene_data["size_m"]
    if size is None:  # what the reference image shows, as if it faced the camera at the goal
        distance = next((d for d in reversed(log["distance_m"]) if d > 0), 0.3)
        size = [distance * scene_data["camera"][a] / scene_data["camera"][b] for a, b in (("width", "px"), ("height", "py"))]
    poses = world @ fMc[seen] @ cMo[seen]
    times = np.array(log["time_s"])[index][seen]
    track = {"t": times.round(4).tolist(), "pose": poses.round(5).tolist()}
    return [plate(size, poses[0], picture, track if len(seen) > 1 else None)]


def run_of(result, log, base):
    """A run for the 3D view, its arm, its target and what is missing; None where no pose of the camera is known."""
    data = result.summary["scene"]
    if "fMc_tx" in log:
        fMc = columns(log, "fMc_")
    else:  # the camera stands
        fMc = np.tile(data.get("fMc", np.full((4, 4), np.nan)), (len(log["time_s"]), 1, 1)).astype(float)
    known = np.flatnonzero(np.isfinite(fMc).all(axis=(1, 2)))
    if len(known) < 2:
        return None
    index = known[chosen(len(known))]
    fMc, cMo = fMc[index], columns(log, "cMo_")[index]
    has_arm = (result.folder / "arm.json").is_file()
    arm, missing = arm_of(result.json("arm.json"), result.folder) if has_arm else (NO_ARM, [])
    joints = [name for name in log if name.startswith("q_")]
    q = np.array([np.array(log[name])[index] for name in joints]).T.round(4).tolist() if has_arm else [[] for _ in index]
    from_start = not has_arm and np.abs(fMc[0] - np.eye(4)).max() < 1e-6  # then y is down
    world = Z_UP if from_start else np.eye(4)
    picture = photograph(result.bytes(data["picture"])) if data["picture"] else None
    goals = [[0, outline(data["goal"], data["size_m"])]] if data["goal"] else []
    depth = 0.3 * np.nanmedian(cMo[:, 2, 3]) if np.isfinite(cMo).any() else 0.1
    run = {
        "name": result.name,
        "t": np.array(log["time_s"])[index].round(4).tolist(),
        "q": q,
        "camera": camera(data["camera"], world @ fMc, max(0.02, depth), goals),
    }
    return run, arm, seen_target(log, index, fMc, cMo, base @ world, data, picture), missing


def add_view(page, results, logs):
    """Several results beside each other."""
    arms, runs, objects, missing = [], [], [], []
    for result, log in zip(results, logs):
        base = np.array(base_at(beside(OTHER_SIDE * len(runs))))
        made = run_of(result, log, base) if len(log["time_s"]) > 1 else None
        if made is None:
            missing.append(f"{result.name}: the robot told no pose of its camera, so it is not shown.")
            continue
        run, arm, target, not_read = made
        runs.append(run | {"colour": COLOURS[len(runs) % len(COLOURS)], "arm": len(runs), "base": base.tolist()})
        arms.append(arm)
        objects += target
        missing += not_read
    if runs:
        goal = "; blue: where the target is at the goal" if any(run["camera"]["goals"] for run in runs) else ""
        page.view(
            scene(arms, runs, objects),
            "The camera with its way; the slider moves time. The target is where the camera saw it. In the corner, and in front of the camera: "
            f"the image that it sees, rendered here without distortion{goal}. The grid has squares of 10 cm. "
            "Drag to turn, the wheel or two fingers to zoom.",
        )
    page.items(*missing)


def settings_of(summary):
    s = summary["settings"]
    limits = (
        f"{number(1e3 * s['linear_velocity_mps'])} mm/s, {number(s['linear_acceleration_mps2'])} m/s², {number(s['linear_jerk_mps3'])} m/s³; "
        f"{number(DEGREES * s['angular_velocity_radps'])}°/s, {number(s['angular_acceleration_radps2'])} rad/s², "
        f"{number(s['angular_jerk_radps3'])} rad/s³"
    )
    return [
        ("camera", f"{summary['camera']}, by {summary['clock']}"),
        ("target", summary["target"]),
        ("robot", summary["robot"] + (", not commanded (dry run)" if summary["dry_run"] else "")),
        ("laws used", listed(summary["laws"])),
        ("gain", f"{number(s['lambda'])} 1/s"),
        ("limits", limits),
        ("control period", f"{number(1e3 * s['period_s'])} ms"),
        *((key, summary[key]) for key in ("command", "version")),
    ]


def page(results):
    if results[0].kind.endswith("--replay"):
        return replayed(results)
    what = [", ".join(r.summary[key] for key in ("camera", "robot", "target")) for r in results]
    page = Page("Visual servoing", "; ".join(what) + ".", results)
    logs = [result.table("log.csv", most=ROWS) for result in results]
    page.section("The way there")
    add_view(page, results, logs)
    for result, log in zip(results, logs):
        page.section("What the camera saw", result)
        if (result.folder / "view.mp4").is_file():
            page.video(
                result.beside(results[0], "view.mp4"),
                "What the camera saw. Green: the target as it was found; blue, dashed: where it is at the goal; yellow: the way of its "
                "corners in the last 3 s.",
            )
        if result.bytes("view.png"):
            page.picture(result.bytes("view.png"), "image/png", "The last image", "The last image, marked in the same way.", 640)
        page.section("Motion", result)
        add_motion(page, log, result.summary["settings"])
        page.section("Status", result)
        add_events(page, result)
        page.section("Time", result)
        add_times(page, result.summary)
    for result in results:
        page.section("Settings", result)
        page.facts(settings_of(result.summary), "What was run.")
    page.paragraph(
        "Beside this page: log.csv (every cycle), images.csv (every image), events.csv (every change of status), camera.mkv (the images "
        "without loss, for visp-servo --replay), view.mp4, summary.json. data/servo/README.md describes their columns."
    )
    return page


def replay_figure(log):
    panels = [
        ("speed (mm/s)", lambda name: 1e3 * norm(log, f"{name}_v_", LINEAR)),
        ("angular speed (°/s)", lambda name: DEGREES * norm(log, f"{name}_v_", ANGULAR)),
        ("to the goal (mm)", lambda name: 1e3 * np.array(log[f"{name}_position_error_m"])),
    ]
    pairs = [("recorded", "#999999"), ("replayed", COLOURS[0])]
    curves = [(label, [(values(name), paint, name) for name, paint in pairs], None) for label, values in panels]
    return panels_figure(np.array(log["time_s"]), curves)


def replayed(results):
    recordings = listed(r.summary["recording"] for r in results)
    page = Page("Visual servoing, replayed", f"The images and the motion of {recordings}, seen and steered once more.", results)
    for result in results:
        page.section("What would have been different", f"What would have been different in {result.name}")
        page.figure(
            replay_figure(result.table("replay.csv", most=ROWS)).named("replay", "Speeds and errors, recorded and replayed"),
            "The robot moves as it was recorded: the replayed law is asked at each recorded place what it would do there. Where the curves "
            "part, another way would have begun.",
        )
    page.section("Settings")
    for result in results:
        s = result.summary
        page.facts([(key, s[key]) for key in ("law", "command", "version")], page.name(result, "What was run."))
    return page
