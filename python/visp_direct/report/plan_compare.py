# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-plan-compare: what each method is good for, then each scene with its runs in 3D, its table and its curves."""
import numpy as np

from . import runs, view3d
from .page import Cell, Page, counted, number
from .plots import Figure, colour, legend_above

COLUMNS = [
    "success (%)", "95 % interval (%)", "touched", "hit at rest", "clearance (mm)", "from the goal (mm)", "duration (s)", "path (m)", "speed (m/s)",
    "acceleration (m/s²)", "jerk (m/s³)", "jerk² (m²/s⁵)", "look (ms), 50 %", "95 %", "99 %", "stops", "false", "over v, tool", "over a", "over v, joints", "over a",
]  # fmt: skip
COLUMNS_SAY = (
    "Touched: runs in which the arm touched something while it moved; hit at rest: something ran into the standing "
    "arm. Clearance: the least of all runs, "
    "at every instant (negative: depth). From the goal, duration, path, jerk² (integral of the squared jerk): medians; "
    "all but the first of the "
    "successes. Speed, acceleration, jerk: the largest of all runs. Look: wall time of a look at the scene. Stops, and "
    "how many of them were false. "
    "Over: runs above a bound of the tool or a limit of a joint."
)
SENSES = {"attract": 1, "none": 6, "repel": 0}  # colours


def named(method):
    return f"{method['number']} {method['name']}".strip()


class Data:
    """One result, with its cells by scene and method."""

    def __init__(self, result):
        self.result, self.summary = result, result.summary
        self.names = {method["id"]: named(method) for method in self.summary["methods"]}
        self.colours = {method: colour(i) for i, method in enumerate(self.names)}
        self.cells = {(cell["scene"], cell["method"]): cell for cell in self.summary["results"]}
        self.runs = {key: np.array(column) for key, column in result.table("runs.csv").items()}
        self.arm = result.json("arm.json")
        self.part, self.missing = view3d.arm_of(self.arm, result.folder)

    def largest(self, scene, method, metric):
        chosen = (self.runs["scene"] == scene) & (self.runs["method"] == method)
        return float(self.runs[metric][chosen].max(initial=0))

    def logs(self, scene):
        """Tables of the shown runs by method."""
        return {log["method"]: self.result.table(log["file"]) for log in self.summary["logs"] if log["scene"] == scene}

    def objects(self, scene):
        return next(self.result.json(log["scene_file"]) for log in self.summary["logs"] if log["scene"] == scene)


def main_table(page, compared):
    several, first = len(compared) > 1, compared[0]
    scenes = first.summary["scenes"]
    header = [*(["result"] if several else []), "method"]
    for scene in scenes:
        header += [f"{scene['id']} {scene['name']}: success (%)", f"{scene['id']}: (s)"]
    rows = []
    for data in compared:
        for method, name in data.names.items():
            row = [*([data.result.name] if several else []), name]
            for scene in scenes:
                cell = data.cells.get((scene["id"], method))
                if cell is None:
                    row += [None, None]
                    continue
                most = max(other["successes"] for (where, _), other in data.cells.items() if where == scene["id"])
                best = cell["successes"] == most > 0
                style = "best" if best else "worst" if cell["runs_with_collision_moving"] else ""
                row += [Cell(100 * cell["success"], style), cell["duration_s"]["median"] if cell["successes"] else None]
            rows.append(row)
    page.table(
        header,
        rows,
        "Share of the runs that succeed, and median duration of those. Green: the most successes on a scene. Red: the "
        "arm touched something while moving in "
        "at least one run, and others have more successes. Counts and intervals are in the sections of the scenes.",
    )


def scene_row(data, scene, method):
    cell = data.cells[scene, method]
    low, high = cell["success_wilson_95"]
    good = cell["successes"] > 0
    replan = cell["replan_ms"]
    return [
        100 * cell["success"],
        f"{number(100 * low)}–{number(100 * high)}, {cell['successes']} of {cell['runs']}",
        cell["runs_with_collision_moving"],
        cell["runs_with_collision_standing"],
        1000 * cell["min_clearance_m"],
        None if cell["goal_error_m"]["median"] is None else 1000 * max(0.0, round(cell["goal_error_m"]["median"], 8)),
        *(cell[key]["median"] if good else None for key in ("duration_s", "path_length")),
        *(data.largest(scene, method, key) for key in ("peak_v", "peak_a", "peak_jerk")),
        cell["jerk_integral"]["median"] if good else None,
        *(replan[key] for key in ("p50", "p95", "p99")),
        cell["stops"],
        cell["false_stops"],
        *(
            cell[f"runs_over_{key}"]
            for key in ("tool_velocity", "tool_acceleration", "joint_velocity", "joint_acceleration")
        ),
    ]


def variant_table(page, data, scene):
    cells = [cell for cell in data.summary["variants"] if cell["scene"] == scene]
    variants = list(dict.fromkeys(cell["variant"] for cell in cells))
    if variants:
        found = {(cell["method"], cell["variant"]): cell for cell in cells}
        page.table(
            ["method", *variants],
            [[name, *(Cell(found[method, v]["successes"]) for v in variants)] for method, name in data.names.items()],
            "Successes by what differs among the runs of this scene, of "
            f"{', '.join(sorted({str(cell['runs']) for cell in cells}))} each.",
        )


def add_view(page, data, scene):
    """The best method on the left; on the right the one with the fewest successes, until the reader chooses another."""
    tables, objects = data.logs(scene["id"]), data.objects(scene["id"])
    best = scene["best"]
    worst = min(
        (method for method in tables if method != best),
        key=lambda m: data.cells[scene["id"], m]["successes"],
        default=None,
    )
    moves = [runs.run_of(table, data.arm, data.names[method], data.colours[method]) for method, table in tables.items()]
    parts, missing = view3d.objects_of(objects, data.result.folder)
    parts += runs.marks_of(tables[best])
    sides = {}
    if worst is not None:
        shift, order = view3d.beside(runs.room_of(tables.values(), objects["objects"])), list(tables)
        parts += [view3d.shifted(part, shift) for part in parts]
        sides = {
            "sides": [
                {"base": None, "run": order.index(best)},
                {"base": view3d.base_at(shift), "run": order.index(worst)},
            ]
        }
    page.view(
        view3d.scene([data.part], moves, parts, objects["ground"], **sides),
        (f"Shown: {scene['shown']}. " if scene["shown"] else "")
        + "Press Play, or move the slider"
        + (
            "; the menus choose the methods on the left and on the right. Lines: the ways of all methods' tools"
            if sides
            else ". Line: the way of the tool"
        )
        + "; grey ball: start; black ball: goal. Obstacles: grey what was known from the start, brown what had to be seen. The grid has squares of 10 cm.",
    )
    page.items(missing)
    return tables


def add_scene(page, data, scene, several):
    title = scene["id"] if scene["id"] == scene["name"] else f"{scene['id']} {scene['name']}"
    page.section(f"{data.result.name}: {title}" if several else title)
    page.paragraph(scene["sentence"])
    page.items(scene["findings"])
    tables = add_view(page, data, scene)
    page.table(
        ["method", *COLUMNS],
        [[name, *scene_row(data, scene["id"], method)] for method, name in data.names.items()],
        COLUMNS_SAY,
    )
    variant_table(page, data, scene["id"])
    limits, curves = data.summary["limits"], []
    for method, table in tables.items():
        t, tool = np.array(table["time_s"]), runs.places_of(table)
        v = np.diff(tool, axis=0, prepend=tool[:1]) / max(np.median(np.diff(t)) if len(t) > 1 else 1, 1e-6)
        a = np.diff(v, axis=0, prepend=v[:1]) / max(np.median(np.diff(t)) if len(t) > 1 else 1, 1e-6)
        curves.append(
            (data.names[method], data.colours[method], table, np.linalg.norm(v, axis=1), np.linalg.norm(a, axis=1))
        )
    page.figure(
        runs.times_figure(curves, (limits["max_velocity_mps"], limits["max_acceleration_mps2"])),
        f"{scene['id']}-times",
        f"{scene['id']}: speed, acceleration, clearance and distance from the goal",
        f"The first run of every method: speed and acceleration of the true tool. {runs.CUT_SAYS} The clearance is the "
        "least of all pairs of parts "
        "that must not touch, the arm's own among them.",
    )
    ways = [(data.names[method], data.colours[method], runs.places_of(table)) for method, table in tables.items()]
    page.figure(
        runs.way_figure(
            ways, data.objects(scene["id"]), data.result.folder, runs.places_of(tables[scene["best"]], "goal")[-1]
        ),
        f"{scene['id']}-ways",
        f"{scene['id']}: the ways of the tools from above and from the side",
        "The same runs: the ways of the tools from above (top) and from the side, and the obstacles where they are at "
        "the start.",
    )


def self_motion_figure(table):
    columns = {key: np.array(value) for key, value in table.items()}
    names = list(dict.fromkeys(table["index"]))

    def draw(panels):
        for axes, name in zip(panels, names):
            for sense, shade in SENSES.items():
                for share in np.unique(columns["share"][columns["sense"] == sense]):
                    rows = (columns["index"] == name) & (columns["sense"] == sense) & (columns["share"] == share)
                    label = f"{sense} {number(float(share))}" if share > 0 else "no self-motion"
                    style = "--" if 0 < share < 0.5 else "-"
                    axes.plot(
                        columns["time_s"][rows],
                        1000 * columns["distance_m"][rows],
                        style,
                        color=colour(shade),
                        label=label,
                    )
            axes.set_ylabel(f"from the {name} (mm)")
        panels[-1].set_xlabel("time (s)")
        legend_above(panels[0], 5)

    return Figure(draw, len(names), 1.8)


def add_self_motion(page, data):
    page.section("S5 self-motion")
    page.paragraph(data.summary["self_motion_sentence"])
    page.paragraph(data.summary["self_motion_finding"])
    page.table(
        [
            "index",
            "sense",
            "share",
            "drift (µm)",
            "turn (mrad)",
            "distance at start (mm)",
            "mean (mm)",
            "end (mm)",
            "way of the joints (rad)",
        ],
        [
            [
                row["index"],
                row["sense"],
                row["share"],
                1e6 * row["tcp_drift_m"],
                1e3 * row["tcp_drift_rad"],
                *(1000 * row[f"{key}_distance_m"] for key in ("start", "mean", "end")),
                row["joint_travel_rad"],
            ]
            for row in data.summary["self_motion"]
        ],
        "Distance of joint 4; drift and turn of the tool are the largest. Share: length of the self-motion relative to "
        "the motion of the task.",
    )
    page.figure(
        self_motion_figure(data.result.table("self-motion.csv")),
        "S5-distances",
        "S5: distance of joint 4 from a point, a line and a plane",
        "Figures 8.14 to 8.17: repulsion raises the distance of joint 4 and attraction lowers it, while the tool goes "
        "through the same places.",
    )


def add_validators(page, summary):
    page.section("S4: proofs and samples")
    page.paragraph(
        "RRTConnect on the tasks of S4 with three ways of looking at the motions between configurations: proofs that "
        "hold between samples, samples at a "
        "fixed step with the same distances, and the usual set-up, samples with FCL. A margin of 0 is asked for. One "
        "plan at a time on this machine."
    )
    page.paragraph(summary["validator_finding"])
    page.table(
        ["scene", "motions", "plans", "solved", "median (ms)", "95 % (ms)", "colliding"],
        [
            [
                row["scene"],
                row["validator"],
                row["plans"],
                row["solved"],
                row["planning_ms_p50"],
                row["planning_ms_p95"],
                Cell(row["colliding_at_10000_places"], "worst" if row["colliding_at_10000_places"] else ""),
            ]
            for row in summary["validators"]
        ],
        "Planning time without set-up and shortening; paths that touch something at one of 10,000 places.",
    )


def add_how(page, compared):
    limits = compared[0].summary["limits"]
    page.section("How it was run")
    page.items(
        [
            "The arm, its drives, the sensor and the obstacles are simulated; nothing here was measured on a robot.",
            "Every method gets the same scenes, seeds, noise and limits. A scene is drawn by its seed alone and "
            "certified to have a way before any method "
            "runs on it.",
            f"Success: the tool within {number(1000 * limits['goal_tolerance_m']) if limits else 2} mm of the goal, at "
            "rest, in time, and nothing touched "
            "while the arm moved.",
            "A stop is false when nothing truly was in the way: neither with the joints at the velocities before it "
            "for another second, nor with joints or "
            "tool going straight to the goal, nothing would have come nearer than the margin and 20 mm. Stops for "
            "obstacles on other ways count as false.",
            "Intervals are Wilson's, 95 %; pairs are compared by McNemar's exact test.",
            "Planners that search have limits of time: on a slower machine their results may differ. All else repeats.",
        ]
    )
    for data in compared:
        page.items([*data.summary["remarks"], *data.missing])
        page.facts(
            [
                ("Arm", data.summary["arm"]),
                ("Runs", str(len(data.runs["seed"]))),
                ("Program", f"visp-plan-compare {data.summary['version']}"),
                ("Command", data.summary["command_line"]),
                ("Wall time", f"{number(data.summary['wall_time_s'])} s"),
            ],
            "summary.json and runs.csv have all numbers, arena/ has logs for Planner Arena.",
        )


def page(results):
    compared, several = [Data(result) for result in results], len(results) > 1
    first = compared[0].summary
    page = Page(
        "Ways round obstacles compared",
        f"{counted(len(first['methods']), 'method')} on {counted(first['problems'], 'scene')} of a simulated arm: what "
        "each is good for.",
    )
    for data in compared:
        sentences = [
            *data.summary["answer"],
            *([data.summary["self_motion_finding"]] if not data.summary["answer"] else []),
        ]
        page.answers(
            *(f"{data.result.name}: {sentence}" if several else sentence for sentence in sentences if sentence)
        )
    if first["scenes"]:
        page.section("What each method is good for")
        main_table(page, compared)
        for data in compared:
            page.table(
                ["method", "what it does", "what it is good for"],
                [[named(method), method["sentence"], method["verdict"]] for method in data.summary["methods"]],
                f"Computed from the runs of {data.result.name}."
                if several
                else "Computed from the runs of this report.",
            )
    for data in compared:
        for scene in data.summary["scenes"]:
            add_scene(page, data, scene, several)
        if data.summary["self_motion"]:
            add_self_motion(page, data)
        if data.summary["validators"]:
            add_validators(page, data.summary)
    add_how(page, compared)
    return page
