# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-avoid-obstacle: the way past what the camera saw, what it saw, and the motion."""
import numpy as np

from . import runs, view3d
from .page import Page, data_uri, number
from .plots import colour, figure, legend_above, logarithmic_if_flat

SHEET = 6  # pictures of the camera in the page, beside those in the 3D view


def scene_of(logged):
    """The runs beside each other, each with its obstacles, and what the camera saw if there is one run. Also sentences."""
    room = runs.room_of([run.table for run in logged], [item for run in logged for item in run.scene["objects"]])
    arms, moves, objects, missing = [], [], [], []
    for i, run in enumerate(logged):
        shift = view3d.beside(i * room) if i else None
        part, move, things, lost = run.shown(colour(i), i, shift)
        for item in run.scene.get("believed", []):
            if item["kind"] != "octree":  # a map is kept as a dot
                believed = {**view3d.object_of(item, run.result.folder), "colour": "#c00000", "wire": True}
                things.append(view3d.shifted(believed, shift))
        arms, moves, objects, missing = [*arms, part], [*moves, move], objects + things, missing + lost
    pictures = pictures_of(logged[0].result) if len(logged) == 1 else []
    seen = {"pictures": dict(zip(("t", "uri"), map(list, zip(*pictures))))} if pictures else {}
    return view3d.scene(arms, moves, objects, logged[0].scene["ground"], **seen), missing


def pictures_of(result):
    """Of the camera, with their times; none where it took none."""
    views = result.table("views.csv") if "views.csv" in result.files() else {"file": []}
    return [(t, data_uri(result.bytes(name))) for t, name in zip(views.get("time_s", []), views["file"])]


def shown_views(result, pictures):
    """From the first picture to the last in which something was seen, and the last of all."""
    frames, times = result.table("frames.csv"), [t for t, _ in pictures]
    seen = [t for t, found in zip(frames["time_s"], frames["seen"]) if found == 1]
    last = np.searchsorted(times, seen[-1] + 1e-9) - 1 if seen else len(times) - 1
    chosen = np.append(np.linspace(0, max(0, last), SHEET - 1).round().astype(int), len(times) - 1)
    return [(f"{number(pictures[i][0])} s", pictures[i][1]) for i in np.unique(chosen)]


@figure(3, 1.7)
def tracks_figure(panels, tracks, frames):
    columns, sights = ({key: np.array(table[key]) for key in table} for table in (tracks, frames))
    for i, name in enumerate(dict.fromkeys([*frames["object"], *tracks["object"]])):
        rows = np.array([other == name for other in tracks["object"]], bool)
        seen = np.array([other == name and found == 1 for other, found in zip(frames["object"], frames["seen"])], bool)
        t, shade = columns["time_s"][rows].astype(float), colour(i)
        if seen.any():
            errors = 1000 * sights["error_m"][seen].astype(float)
            panels[0].plot(sights["time_s"][seen], errors, ".", color=shade, markersize=3, label=f"{name}, error of sightings")
        if not rows.any():
            continue
        error, inflation = (1000 * columns[key][rows].astype(float) for key in ("error_m", "inflation_m"))
        rate = np.linalg.norm([columns[f"velocity_{axis}_mps"][rows].astype(float) for axis in "xyz"], axis=0)
        panels[0].plot(*runs.thinned(t, error), color=shade, label=f"{name}, error of track")
        panels[0].plot(*runs.thinned(t, inflation), "--", color=shade, linewidth=1, label=f"{name}, inflation")
        panels[1].plot(*runs.thinned(t, rate), color=shade)
        panels[2].plot(*runs.thinned(t, columns["confidence"][rows].astype(float), np.min), color=shade)
    if not len(columns["time_s"]):
        panels[0].plot([], [], " ", label="nothing was ever seen")
    logarithmic_if_flat(panels[0], *(1000 * columns[key].astype(float) for key in ("error_m", "inflation_m")))
    for axes, label in zip(panels, ("error (mm)", "speed (m/s)", "confidence")):
        axes.set(ylabel=label, ylim=(0, None))
    panels[-1].set_xlabel("time (s)")
    legend_above(panels[0], 3)


@figure(1, 2.2)
def joints_figure(axes, table, arm):
    for i, joint in enumerate(arm["joints"]):
        if joint["velocity"]:
            share = np.abs(table[f"command_{joint['name']}"]) / joint["velocity"]
            axes.plot(*runs.thinned(table["time_s"], share), color=colour(i), label=joint["name"], linewidth=1.2)
    runs.level(axes, 1, "limit")
    legend_above(axes, 5, xlabel="time (s)", ylabel="joint speed / limit")


COMPARED = [
    "result = name; method = settings.method; arrived = metrics.success; duration (s) = metrics.duration_s; from the goal (mm) = "
    "1000 metrics.goal_error_m; least clearance (mm) = 1000 metrics.min_clearance_m; speed (m/s) = metrics.peak_v; "
    "acceleration (m/s²) = metrics.peak_a; stops = metrics.stops"
]
TURNS = [
    "from (s) = time_s",
    ("status", lambda turn: turn["status"] + (", protective stop" if turn["stopping"] else "")),
    "what it means = means",
]


def mm_if(condition, key):
    return lambda obstacle: None if None in (obstacle[condition], obstacle[key]) else 1000 * obstacle[key]


SEEN = [
    "obstacle = object; pictures; seen in = seen; first seen (s) = first_seen_s; known from (s) = known_s; last seen (s) = last_seen_s; "
    "longest gap (s) = longest_gap_s",
    ("error (mm), median", mm_if("first_seen_s", "median_error_m")),
    ("worst", mm_if("first_seen_s", "worst_error_m")),
    ("reported sigma (mm)", mm_if("first_seen_s", "median_sigma_m")),
    ("track: worst error (mm)", mm_if("known_s", "worst_track_error_m")),
    ("least inflation − error (mm)", mm_if("known_s", "least_inflation_less_error_m")),
]


def add_seen(page, result):
    page.section("What was seen", f"What {result.name} saw")
    pictures = pictures_of(result)
    if pictures:
        page.pictures(
            shown_views(result, pictures),
            "The camera in the hand: from the first picture to the last one in which something was seen, and the last "
            "of all. What was found is outlined.",
        )
    says = "An obstacle is known to the method from the time on when the result of the first picture arrives."
    page.records(result.summary["obstacles"], SEEN, says)
    tracks = tracks_figure(result.table("tracks.csv"), result.table("frames.csv"))
    page.figure(
        tracks.named(f"tracks-{result.name}", "Errors, speeds and confidence of the track table"),
        "The track table. Points: sightings. The method inflates each obstacle (dashed), which must stay above the "
        "error of the track; it grows while the obstacle is out of view.",
    )


def add_motion(page, run):
    summary, table = run.result.summary, run.table
    m, limits = summary["metrics"], summary["settings"]
    speed, acceleration = limits["max_velocity_mps"], limits["max_acceleration_mps2"]
    page.section("Motion", run.result)
    page.facts(
        [
            ("Ended", m["status"]),
            ("Duration", f"{number(m['duration_s'])} s"),
            ("Distance from the goal in the end", f"{number(1000 * m['goal_error_m'])} mm"),
            ("Least clearance of the whole arm, true scene, at every instant", f"{number(1000 * m['min_clearance_m'])} mm"),
            ("Commanded tool, speed", f"{number(m['peak_v'])} of {number(speed)} m/s"),
            ("Commanded tool, acceleration", f"{number(m['peak_a'])} of {number(acceleration)} m/s²"),
            ("Periods over these bounds without a protective stop", f"{m['tool_v_violations']} and {m['tool_a_violations']}"),
            ("Joints, part of their velocity limits", f"{number(100 * summary['joint_velocity_share'])} %"),
            ("Joints, part of their acceleration limits", f"{number(100 * summary['joint_acceleration_share'])} %"),
            ("Protective stops", f"{m['stops']}, {m['false_stops']} of them without a reason"),
            ("Way of the tool", f"{number(m['path_length'])} m"),
            ("Time of a look at a new picture, median and 99 %", f"{number(m['replan_ms_p50'])} and {number(m['replan_ms_p99'])} ms"),
        ],
        "The run in numbers.",
    )
    curve = ("commanded tool", colour(0), table, table["commanded_speed_mps"], table["commanded_acceleration_mps2"])
    times = runs.times_figure([curve], (speed, acceleration))
    page.figure(
        times.named(f"times-{run.name}", "Speed and acceleration of the tool, clearance and distance from the goal over time"),
        f"Speed and acceleration of the commanded tool. {runs.CUT_SAYS} {runs.CLEARANCE_SAYS}",
    )
    page.figure(
        joints_figure(table, run.arm).named(f"joints-{run.name}", "Joint speeds as parts of their limits"),
        "Commanded speeds of the joints as parts of their limits.",
    )
    way = [("tool", colour(1), runs.places_of(table))]
    way = runs.way_figure(way, run.scene, run.result.folder, runs.places_of(table, "goal")[-1])
    page.figure(
        way.named(f"way-{run.name}", "The way of the tool from above and from the side"),
        "The way of the tool from above (top) and from the side, and the obstacles where they are at the start.",
    )


def settings(summary):
    s = summary["settings"]
    hidden = [f"{number(a)} to {number(b)} s" for a, b in s["hidden_s"]]
    real = f"PD with gravity, torques at 1 kHz against {number(s['friction'])} times the friction of the file"
    forgotten = f"is forgotten after {number(s['forget_s'])} s"
    return [
        ("Command", summary["command_line"]),
        ("Arm", summary["arm"]),
        ("Scene, motion", f"{summary['scene']}, {summary['task']}"),
        ("Method", s["method"]),
        ("Control", f"{number(1 / s['period_s'])} Hz"),
        ("Sensor", f"{s['sensor']} at {number(s['vision_rate_hz'])} Hz, {number(1000 * s['latency_s'])} ms from exposure to result"),
        ("Camera covered", ", ".join(hidden) or "never"),
        ("Noise of pictures", f"{number(s['noise_grey'])} grey values"),
        ("Drives", "ideal" if s["ideal_drives"] else real),
        ("What is out of view", forgotten if s["forget_s"] > 0 else "stays where it was, and its uncertainty grows"),
        ("Seed", str(s["seed"])),
    ]


def page(results):
    page = Page(
        f"Avoiding what the camera sees: {results[0].summary['scene']}",
        "Arm, drives and camera are simulated; the obstacles' photographs are real, their views rendered.",
        results,
    )
    page.section("What happened")
    if page.several:
        compared = [{"name": result.name, **result.summary} for result in results]
        page.records(compared, COMPARED, "Speed and acceleration: the largest of the commanded tool.")
    logged = [runs.Logged(result) for result in results]
    scene, missing = scene_of(logged)
    page.view(
        scene,
        "Press Play, or move the slider. Line: the way of the tool; grey ball: start; black ball: goal. Obstacles: "
        "grey what was known from the start, "
        "brown what had to be seen; red wire: as the track table had it in the end, with its uncertainty. The grid has "
        "squares of 10 cm." + (" The picture is what the camera saw then." if "pictures" in scene else ""),
    )
    page.items(*missing)
    for result in results:
        if page.several:
            page.section(f"What {result.name} did")
        says = "What the method did; changes shorter than 50 ms are left out."
        page.records(result.summary["turns"], TURNS, says)
        video = result.summary.get("video")
        if video and video["for_browsers"] and result is results[0]:
            page.video(video["file"], "What the camera saw, in real time.")
        elif video:
            players = "" if video["for_browsers"] else ", for players; browsers do not play it"
            page.paragraph(f"Video of the camera: {video['file']} in {result.name}{players}.")
    for run in logged:
        add_seen(page, run.result)
        add_motion(page, run)
    page.section("How it was made")
    for result in results:
        page.facts(settings(result.summary), page.name(result))
        page.items(*result.summary["warnings"])
    return page
