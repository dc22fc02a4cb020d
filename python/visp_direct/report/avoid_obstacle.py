# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-avoid-obstacle: the way past what the camera saw, what it saw, and the motion."""
import base64

import numpy as np

from . import runs, view3d
from .page import Page, counted, number
from .plots import Figure, colour, legend_above, logarithmic_if_flat

SHEET = 6  # pictures of the camera in the page, beside those in the 3D view


def scene_of(results):
    """The runs beside each other, each with its obstacles, and what the camera saw if there is one run. Also sentences."""
    loaded = [(result.json("arm.json"), result.json("scene.json"), result.table("samples.csv")) for result in results]
    room = runs.room_of([table for *_, table in loaded], [item for _, data, _ in loaded for item in data["objects"]])
    arms, moves, objects, missing = [], [], [], []
    for i, (result, (arm, data, table)) in enumerate(zip(results, loaded)):
        shift = view3d.beside(i * room) if i else None
        part, lost = view3d.arm_of(arm, result.folder)
        things, gone = view3d.objects_of(data, result.folder, shift)
        arms.append(part)
        moves.append(runs.run_of(table, arm, result.name, colour(i), i, shift))
        objects += things + runs.marks_of(table, shift)
        for item in data.get("believed", []):
            if item["kind"] != "octree":  # a map is kept as a dot
                objects.append(
                    view3d.shifted({**view3d.object_of(item, result.folder), "colour": "#c00000", "wire": True}, shift)
                )
        missing += lost + gone
    return (
        view3d.scene(
            arms, moves, objects, loaded[0][1]["ground"], **(pictures_of(results[0]) if len(results) == 1 else {})
        ),
        missing,
    )


def pictures_of(result):
    if "views.csv" not in result.files() or not result.table("views.csv")["file"]:
        return {}
    views = result.table("views.csv")
    return {"pictures": {"t": views["time_s"], "uri": [uri(result, name) for name in views["file"]]}}


def uri(result, name):
    return f"data:image/jpeg;base64,{base64.b64encode(result.bytes(name)).decode()}"


def shown_views(result):
    """From the first picture to the last in which something was seen, and the last of all."""
    views, frames = result.table("views.csv"), result.table("frames.csv")
    seen = [t for t, found in zip(frames["time_s"], frames["seen"]) if found == 1]
    last = np.searchsorted(views["time_s"], seen[-1] + 1e-9) - 1 if seen else len(views["file"]) - 1
    chosen = np.append(np.linspace(0, max(0, last), SHEET - 1).round().astype(int), len(views["file"]) - 1)
    return [(views["time_s"][i], uri(result, views["file"][i])) for i in np.unique(chosen)]


def tracks_figure(tracks, frames):
    names = list(dict.fromkeys([*frames["object"], *tracks["object"]]))
    columns = {key: np.array(tracks[key]) for key in tracks}
    sights = {key: np.array(frames[key]) for key in frames}

    def draw(panels):
        for i, name in enumerate(names):
            rows = np.array([other == name for other in tracks["object"]], bool)
            seen = np.array(
                [other == name and found == 1 for other, found in zip(frames["object"], frames["seen"])], bool
            )
            t, shade = columns["time_s"][rows].astype(float), colour(i)
            if seen.any():
                panels[0].plot(
                    sights["time_s"][seen],
                    1000 * sights["error_m"][seen].astype(float),
                    ".",
                    color=shade,
                    markersize=3,
                    label=f"{name}, error of sightings",
                )
            if not rows.any():
                continue
            rate = np.linalg.norm([columns[f"velocity_{axis}_mps"][rows].astype(float) for axis in "xyz"], axis=0)
            panels[0].plot(
                *runs.thinned(t, 1000 * columns["error_m"][rows].astype(float)),
                color=shade,
                label=f"{name}, error of track",
            )
            panels[0].plot(
                *runs.thinned(t, 1000 * columns["inflation_m"][rows].astype(float)),
                "--",
                color=shade,
                linewidth=1,
                label=f"{name}, inflation",
            )
            panels[1].plot(*runs.thinned(t, rate), color=shade)
            panels[2].plot(*runs.thinned(t, columns["confidence"][rows].astype(float), np.min), color=shade)
        if not len(columns["time_s"]):
            panels[0].plot([], [], " ", label="nothing was ever seen")
        logarithmic_if_flat(
            panels[0], 1000 * columns["error_m"].astype(float), 1000 * columns["inflation_m"].astype(float)
        )
        for axes, label in zip(panels, ("error (mm)", "speed (m/s)", "confidence")):
            axes.set(ylabel=label, ylim=(0, None))
        panels[-1].set_xlabel("time (s)")
        legend_above(panels[0], 3)

    return Figure(draw, 3, 1.7)


def joints_figure(table, arm):
    def draw(panels):
        axes = panels[0]
        for i, joint in enumerate(arm["joints"]):
            if joint["velocity"]:
                share = np.abs(table[f"command_{joint['name']}"]) / joint["velocity"]
                axes.plot(*runs.thinned(table["time_s"], share), color=colour(i), label=joint["name"], linewidth=1.2)
        runs.level(axes, 1, "limit")
        axes.set(xlabel="time (s)", ylabel="joint speed / limit")
        legend_above(axes, 5)

    return Figure(draw, 1, 2.2)


def comparison(page, results):
    page.table(
        [
            "result",
            "method",
            "arrived",
            "duration (s)",
            "from the goal (mm)",
            "least clearance (mm)",
            "speed (m/s)",
            "acceleration (m/s²)",
            "stops",
        ],
        [
            [
                result.name,
                result.summary["settings"]["method"],
                m["success"],
                m["duration_s"],
                1000 * m["goal_error_m"],
                1000 * m["min_clearance_m"],
                m["peak_v"],
                m["peak_a"],
                m["stops"],
            ]
            for result in results
            for m in [result.summary["metrics"]]
        ],
        "Speed and acceleration: the largest of the commanded tool.",
    )


def add_turns(page, summary):
    page.table(
        ["from (s)", "status", "what it means"],
        [
            [turn["time_s"], turn["status"] + (", protective stop" if turn["stopping"] else ""), turn["means"]]
            for turn in summary["turns"]
        ],
        "What the method did; changes shorter than 50 ms are left out.",
    )


def add_seen(page, result, several):
    page.section(f"What {result.name} saw" if several else "What was seen")
    if "views.csv" in result.files() and result.table("views.csv")["file"]:
        page.pictures(
            [(f"{number(t)} s", picture) for t, picture in shown_views(result)],
            "The camera in the hand: from the first picture to the last one in which something was seen, and the last "
            "of all. What was found is outlined.",
        )
    mm = 1000.0
    page.table(
        [
            "obstacle",
            "pictures",
            "seen in",
            "first seen (s)",
            "known from (s)",
            "last seen (s)",
            "longest gap (s)",
            "error (mm), median",
            "worst",
            "reported sigma (mm)",
            "track: worst error (mm)",
            "least inflation − error (mm)",
        ],
        [
            [
                o["object"],
                o["pictures"],
                o["seen"],
                o["first_seen_s"],
                o["known_s"],
                o["last_seen_s"],
                o["longest_gap_s"],
                *(
                    None if o["first_seen_s"] is None or o[key] is None else mm * o[key]
                    for key in ("median_error_m", "worst_error_m", "median_sigma_m")
                ),
                *(
                    None if o["known_s"] is None or o[key] is None else mm * o[key]
                    for key in ("worst_track_error_m", "least_inflation_less_error_m")
                ),
            ]
            for o in result.summary["obstacles"]
        ],
        "An obstacle is known to the method from the time on when the result of the first picture arrives.",
    )
    page.figure(
        tracks_figure(result.table("tracks.csv"), result.table("frames.csv")),
        f"tracks-{result.name}",
        "Errors, speeds and confidence of the track table",
        "The track table. Points: sightings. The method inflates each obstacle (dashed), which must stay above the "
        "error of the track; it grows "
        "while the obstacle is out of view.",
    )


def add_motion(page, result, several):
    summary, table = result.summary, result.table("samples.csv")
    m, limits = summary["metrics"], summary["settings"]
    page.section(f"Motion of {result.name}" if several else "Motion")
    page.facts(
        [
            ("Ended", m["status"]),
            ("Duration", f"{number(m['duration_s'])} s"),
            ("Distance from the goal in the end", f"{number(1000 * m['goal_error_m'])} mm"),
            (
                "Least clearance of the whole arm, true scene, at every instant",
                f"{number(1000 * m['min_clearance_m'])} mm",
            ),
            ("Commanded tool, speed", f"{number(m['peak_v'])} of {number(limits['max_velocity_mps'])} m/s"),
            (
                "Commanded tool, acceleration",
                f"{number(m['peak_a'])} of {number(limits['max_acceleration_mps2'])} m/s²",
            ),
            (
                "Periods over these bounds without a protective stop",
                f"{m['tool_v_violations']} and {m['tool_a_violations']}",
            ),
            ("Joints, part of their velocity limits", f"{number(100 * summary['joint_velocity_share'])} %"),
            ("Joints, part of their acceleration limits", f"{number(100 * summary['joint_acceleration_share'])} %"),
            ("Protective stops", f"{m['stops']}, {m['false_stops']} of them without a reason"),
            ("Way of the tool", f"{number(m['path_length'])} m"),
            (
                "Time of a look at a new picture, median and 99 %",
                f"{number(m['replan_ms_p50'])} and {number(m['replan_ms_p99'])} ms",
            ),
        ],
        "The run in numbers.",
    )
    curve = ("commanded tool", colour(0), table, table["commanded_speed_mps"], table["commanded_acceleration_mps2"])
    page.figure(
        runs.times_figure([curve], (limits["max_velocity_mps"], limits["max_acceleration_mps2"])),
        f"times-{result.name}",
        "Speed and acceleration of the tool, clearance and distance from the goal over time",
        f"Speed and acceleration of the commanded tool. {runs.CUT_SAYS} The clearance is the least of all pairs of "
        "parts that must not touch, "
        "the arm's own among them.",
    )
    page.figure(
        joints_figure(table, result.json("arm.json")),
        f"joints-{result.name}",
        "Joint speeds as parts of their limits",
        "Commanded speeds of the joints as parts of their limits.",
    )
    page.figure(
        runs.way_figure(
            [("tool", colour(1), runs.places_of(table))],
            result.json("scene.json"),
            result.folder,
            runs.places_of(table, "goal")[-1],
        ),
        f"way-{result.name}",
        "The way of the tool from above and from the side",
        "The way of the tool from above (top) and from the side, and the obstacles where they are at the start.",
    )


def settings(summary):
    s = summary["settings"]
    hidden = [f"{number(a)} to {number(b)} s" for a, b in s["hidden_s"]]
    drives = (
        "ideal"
        if s["ideal_drives"]
        else (
            f"PD with gravity, torques at 1 kHz against {number(s['friction'])} times the "
            "friction of the file"
        )
    )
    return [
        ("Command", summary["command_line"]),
        ("Arm", summary["arm"]),
        ("Scene, motion", f"{summary['scene']}, {summary['task']}"),
        ("Method", s["method"]),
        ("Control", f"{number(1 / s['period_s'])} Hz"),
        (
            "Sensor",
            f"{s['sensor']} at {number(s['vision_rate_hz'])} Hz, {number(1000 * s['latency_s'])} ms from exposure to "
            "result",
        ),
        ("Camera covered", ", ".join(hidden) or "never"),
        ("Noise of pictures", f"{number(s['noise_grey'])} grey values"),
        ("Drives", drives),
        (
            "What is out of view",
            f"is forgotten after {number(s['forget_s'])} s"
            if s["forget_s"] > 0
            else "stays where it was, and its uncertainty grows",
        ),
        ("Seed", str(s["seed"])),
    ]


def page(results):
    if results[0].kind.endswith("--replica"):
        from .detours import page as replica

        return replica(results)
    several = len(results) > 1
    page = Page(
        f"Avoiding what the camera sees: {results[0].summary['scene']}",
        "Arm, drives and camera are simulated; the obstacles' photographs are real, their views rendered.",
    )
    for result in results:
        page.answers(
            *(f"{result.name}: {sentence}" if several else sentence for sentence in result.summary["findings"])
        )
    page.section("What happened")
    if several:
        comparison(page, results)
    scene, missing = scene_of(results)
    page.view(
        scene,
        "Press Play, or move the slider. Line: the way of the tool; grey ball: start; black ball: goal. Obstacles: "
        "grey what was known from the start, "
        "brown what had to be seen; red wire: as the track table had it in the end, with its uncertainty. The grid has "
        "squares of 10 cm." + (" The picture is what the camera saw then." if "pictures" in scene else ""),
    )
    page.items(missing)
    for result in results:
        if several:
            page.section(f"What {result.name} did")
        add_turns(page, result.summary)
        video = result.summary.get("video")
        if video and video["for_browsers"] and result is results[0]:
            page.video(video["file"], "What the camera saw, in real time.")
        elif video:
            page.paragraph(
                f"Video of the camera: {video['file']} in {result.name}"
                + ("." if video["for_browsers"] else ", for players; browsers do not play it.")
            )
    for result in results:
        add_seen(page, result, several)
        add_motion(page, result, several)
    page.section("How it was made")
    for result in results:
        page.facts(settings(result.summary), result.name if several else "")
        page.items(result.summary["warnings"])
    return page
