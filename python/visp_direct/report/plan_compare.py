# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-plan-compare: what each method is good for, then each scene with its runs in 3D, its table and its curves."""
import numpy as np

from . import runs, view3d
from .page import Cell, Page, counted, number
from .plots import Figure, colour, legend_above

COLUMNS_SAY = (
    "Touched: runs in which the arm touched something while it moved; hit at rest: something ran into the standing arm. Clearance: the "
    "least of all runs, at every instant (negative: depth). From the goal, duration, path, jerk² (integral of the squared jerk): medians; "
    "all but the first of the successes. Speed, acceleration, jerk: the largest of all runs. Look: wall time of a look at the scene. "
    "Stops, and how many of them were false. Over: runs above a bound of the tool or a limit of a joint."
)
SENSES = {"attract": 1, "none": 6, "repel": 0}  # colours


def named(method):
    return method["id"]


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
    scenes = compared[0].summary["scenes"]
    header = [*(["result"] if page.several else []), "method"]
    for scene in scenes:
        header += [f"{scene['id']} {scene['name']}: success (%)", f"{scene['id']}: (s)"]
    rows = []
    for data in compared:
        for method, name in data.names.items():
            row = [*([data.result.name] if page.several else []), name]
            for scene in scenes:
                cell = data.cells.get((scene["id"], method))
                if cell is None:
                    row += [None, None]
                    continue
                most = max(other["successes"] for (where, _), other in data.cells.items() if where == scene["id"])
                best = cell["successes"] == most > 0
                style = "best" if best else "worst" if cell["runs_with_collision_moving"] else ""
                row += [Cell(100 * cell["success"], style), of_successes("duration_s")(cell)]
            rows.append(row)
    page.table(
        header,
        rows,
        "Share of the runs that succeed, and median duration of those. Green: the most successes on a scene. Red: the arm touched "
        "something while moving in at least one run, and others have more successes. Counts and intervals are in the sections of the scenes.",
    )


def of_successes(key):
    """The median of a metric; None without a success."""
    return lambda cell: cell[key]["median"] if cell["successes"] else None


def interval(cell):
    low, high = cell["success_wilson_95"]
    return f"{number(100 * low)}–{number(100 * high)}, {cell['successes']} of {cell['runs']}"


def from_goal(cell):
    error = cell["goal_error_m"]["median"]
    return None if error is None else 1000 * max(0.0, round(error, 8))


def columns_in(data):
    """Of the table of a scene, whose rows are its cells."""

    def largest(metric):
        return lambda cell: data.largest(cell["scene"], cell["method"], metric)

    return [
        ("method", lambda cell: data.names[cell["method"]]),
        "success (%) = 100 success",
        ("95 % interval (%)", interval),
        "touched = runs_with_collision_moving; hit at rest = runs_with_collision_standing; clearance (mm) = 1000 min_clearance_m",
        ("from the goal (mm)", from_goal),
        ("duration (s)", of_successes("duration_s")),
        ("path (m)", of_successes("path_length")),
        ("speed (m/s)", largest("peak_v")),
        ("acceleration (m/s²)", largest("peak_a")),
        ("jerk (m/s³)", largest("peak_jerk")),
        ("jerk² (m²/s⁵)", of_successes("jerk_integral")),
        "look (ms), 50 % = replan_ms.p50; 95 % = replan_ms.p95; 99 % = replan_ms.p99; stops; false = false_stops; over v, tool = "
        "runs_over_tool_velocity; over a = runs_over_tool_acceleration; over v, joints = runs_over_joint_velocity; over a = "
        "runs_over_joint_acceleration",
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
    tables, objects, best = data.logs(scene["id"]), data.objects(scene["id"]), scene["best"]
    others = [method for method in tables if method != best]
    worst = min(others, key=lambda m: data.cells[scene["id"], m]["successes"], default=None)
    moves = [runs.run_of(table, data.arm, data.names[method], data.colours[method]) for method, table in tables.items()]
    parts, missing = view3d.objects_of(objects, data.result.folder)
    parts += runs.marks_of(tables[best])
    sides, says = {}, ". Line: the way of the tool"
    if worst is not None:
        shift, order = view3d.beside(runs.room_of(tables.values(), objects["objects"])), list(tables)
        parts += [view3d.shifted(part, shift) for part in parts]
        places = ((None, best), (view3d.base_at(shift), worst))
        sides = {"sides": [{"base": base, "run": order.index(method)} for base, method in places]}
        says = "; the menus choose the methods on the left and on the right. Lines: the ways of all methods' tools"
    page.view(
        view3d.scene([data.part], moves, parts, objects["ground"], **sides),
        (f"Shown: {scene['shown']}. " if scene["shown"] else "")
        + f"Press Play, or move the slider{says}; grey ball: start; black ball: goal. Obstacles: grey what was known from the start, brown "
        "what had to be seen. The grid has squares of 10 cm.",
    )
    page.items(*missing)
    return tables


def add_scene(page, data, scene):
    title = scene["id"] if scene["id"] == scene["name"] else f"{scene['id']} {scene['name']}"
    page.section(title, f"{data.result.name}: {title}")
    page.paragraph(scene["sentence"])
    page.items(*scene["findings"])
    tables = add_view(page, data, scene)
    page.records([data.cells[scene["id"], method] for method in data.names], columns_in(data), COLUMNS_SAY)
    variant_table(page, data, scene["id"])
    limits, curves, ways = data.summary["limits"], [], []
    for method, table in tables.items():
        t, tool = np.array(table["time_s"]), runs.places_of(table)
        step = max(np.median(np.diff(t)) if len(t) > 1 else 1, 1e-6)
        v = np.diff(tool, axis=0, prepend=tool[:1]) / step
        a = np.diff(v, axis=0, prepend=v[:1]) / step
        look = data.names[method], data.colours[method]
        curves.append((*look, table, np.linalg.norm(v, axis=1), np.linalg.norm(a, axis=1)))
        ways.append((*look, tool))
    times = runs.times_figure(curves, (limits["max_velocity_mps"], limits["max_acceleration_mps2"]))
    page.figure(
        times.named(f"{scene['id']}-times", f"{scene['id']}: speed, acceleration, clearance and distance from the goal"),
        f"The first run of every method: speed and acceleration of the true tool. {runs.CUT_SAYS} {runs.CLEARANCE_SAYS}",
    )
    goal = runs.places_of(tables[scene["best"]], "goal")[-1]
    ways = runs.way_figure(ways, data.objects(scene["id"]), data.result.folder, goal)
    page.figure(
        ways.named(f"{scene['id']}-ways", f"{scene['id']}: the ways of the tools from above and from the side"),
        "The same runs: the ways of the tools from above (top) and from the side, and the obstacles where they are at the start.",
    )


SELF_MOTION = [
    "index; sense; share; drift (µm) = 1e6 tcp_drift_m; turn (mrad) = 1e3 tcp_drift_rad; distance at start (mm) = 1000 start_distance_m; "
    "mean (mm) = 1000 mean_distance_m; end (mm) = 1000 end_distance_m; way of the joints (rad) = joint_travel_rad"
]
VALIDATORS = [
    "scene; planner; motions = validator; plans; solved; median (ms) = planning_ms_p50; 95 % (ms) = planning_ms_p95; "
    "length (rad) = length_rad_p50",
    ("colliding", lambda row: Cell(row["colliding_at_10000_places"], "worst" if row["colliding_at_10000_places"] else "")),
]


def self_motion_figure(table):
    columns, names = {key: np.array(value) for key, value in table.items()}, list(dict.fromkeys(table["index"]))

    def draw(panels):
        for axes, name in zip(panels, names):
            for sense, shade in SENSES.items():
                for share in np.unique(columns["share"][columns["sense"] == sense]):
                    rows = (columns["index"] == name) & (columns["sense"] == sense) & (columns["share"] == share)
                    label = f"{sense} {number(float(share))}" if share > 0 else "no self-motion"
                    style, distance = "--" if 0 < share < 0.5 else "-", 1000 * columns["distance_m"][rows]
                    axes.plot(columns["time_s"][rows], distance, style, color=colour(shade), label=label)
            axes.set_ylabel(f"from the {name} (mm)")
        panels[-1].set_xlabel("time (s)")
        legend_above(panels[0], 5)

    return Figure(draw, len(names), 1.8)


def add_self_motion(page, data):
    page.section("S5 self-motion")
    page.paragraph(data.summary["self_motion_sentence"])
    page.paragraph(data.summary["self_motion_finding"])
    page.records(
        data.summary["self_motion"],
        SELF_MOTION,
        "Distance of joint 4; drift and turn of the tool are the largest. Share: length of the self-motion relative to the motion of the "
        "task.",
    )
    drawn = self_motion_figure(data.result.table("self-motion.csv"))
    page.figure(
        drawn.named("S5-distances", "S5: distance of joint 4 from a point, a line and a plane"),
        "Figures 8.14 to 8.17: repulsion raises the distance of joint 4 and attraction lowers it, while the tool goes through the same "
        "places.",
    )


def add_validators(page, summary):
    page.section("S4: proofs and samples")
    page.paragraph(
        "Two trees that grow towards each other, ours (BiRRT) and OMPL's (RRTConnect), on the tasks of S4, with three ways of looking at "
        "the motions between configurations: proofs that hold between samples, samples at a fixed step with the same distances, and the "
        "usual set-up, samples with FCL. A margin of 0 is asked for. One plan at a time on this machine."
    )
    page.paragraph(summary["validator_finding"])
    says = (
        "Planning time without set-up and shortening; median length of the shortened paths; paths that touch something at one of "
        "10,000 places."
    )
    page.records(summary["validators"], VALIDATORS, says)


def add_how(page, compared):
    limits = compared[0].summary["limits"]
    page.section("How it was run")
    page.items(
        "The arm, its drives, the sensor and the obstacles are simulated; nothing here was measured on a robot.",
        "Every method gets the same scenes, seeds, noise and limits. A scene is drawn by its seed alone and certified to have a way "
        "before any method runs on it.",
        f"Success: the tool within {number(1000 * limits['goal_tolerance_m']) if limits else 2} mm of the goal, at rest, in time, and "
        "nothing touched while the arm moved.",
        "A stop is false when nothing truly was in the way: neither with the joints at the velocities before it for another second, nor "
        "with joints or tool going straight to the goal, nothing would have come nearer than the margin and 20 mm. Stops for obstacles "
        "on other ways count as false.",
        "Intervals are Wilson's, 95 %; pairs are compared by McNemar's exact test.",
        "Planners that search have limits of time: on a slower machine their results may differ. All else repeats.",
    )
    for data in compared:
        page.items(*data.summary["remarks"], *data.missing)
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
    compared, first = [Data(result) for result in results], results[0].summary
    counts = f"{counted(len(first['methods']), 'method')} on {counted(first['problems'], 'scene')}"
    page = Page("Ways round obstacles compared", f"{counts} of a simulated arm: what each is good for.", results)
    for result in results:
        sentences = result.summary["answer"] or [result.summary["self_motion_finding"]]
        page.answers(*filter(None, sentences), of=result)
    if first["scenes"]:
        page.section("What each method is good for")
        main_table(page, compared)
        columns = [("method", named), "what it does = sentence; what it is good for = verdict"]
        for result in results:
            which = result.name if page.several else "this report"
            page.records(result.summary["methods"], columns, f"Computed from the runs of {which}.")
    for data in compared:
        for scene in data.summary["scenes"]:
            add_scene(page, data, scene)
        if data.summary["self_motion"]:
            add_self_motion(page, data)
        if data.summary["validators"]:
            add_validators(page, data.summary)
    add_how(page, compared)
    return page
