# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Replicas of figures 8.6 to 8.13 of the thesis by visp-avoid-obstacle --replica. figure() also serves other reports."""
import numpy as np

from . import runs, view3d
from .page import Page, number
from .plots import Figure, colour, legend_above

SNAPSHOTS = 6
KINDS = {"field-strict.csv": "field", "point.csv": "point", "samples.csv": "arm"}


def way_of(table):
    return np.stack([table["x_m"], table["y_m"]], axis=1)


def place_axes(axes):
    axes.set(xlabel="x (m)", ylabel="y (m)")
    axes.set_aspect("equal", "datalim")
    legend_above(axes, 3)


def points(axes, places, shade, label):
    if len(places):
        axes.plot(*np.array(places).T, "o", color=shade, markersize=4, label=label)


def field_figure(numbers, tables):
    """Figure 8.6: ways through a potential field with strict and mild parameters."""
    strict, mild, alone = (tables[f"field-{name}.csv"] for name in ("strict", "mild", "alone"))

    def draw(panels):
        for axes, table, name in zip(panels, (strict, mild), ("strict", "mild")):
            axes.plot(*way_of(table).T, color=colour(1), label=f"way, {name} parameters")
            axes.plot(*way_of(alone).T, "--", color="#999999", linewidth=1, label="without obstacle")
            points(axes, numbers["places_m"], colour(0), "vias and end")
            points(axes, [numbers["obstacle_m"]], "#000000", "obstacle")
            turn = np.linspace(0, 2 * np.pi, 90)
            circle = (
                np.stack([np.cos(turn), np.sin(turn)]) * numbers[name]["d0_m"]
                + np.array(numbers["obstacle_m"])[:, None]
            )
            axes.plot(*circle, "--", color="#000000", linewidth=0.8, label="half the weight")
            place_axes(axes)
        panels[2].plot(strict["time_s"], strict["weight"], color=colour(1), label="strict")
        panels[2].plot(mild["time_s"], mild["weight"], color=colour(0), label="mild")
        panels[2].set(xlabel="time (s)", ylabel="weight of avoidance")
        legend_above(panels[2])

    return Figure(draw, 3, 3.0, shared=False)


def point_figure(numbers, tables):
    """Figures 8.7, 8.9 and 8.13: a point in the plane."""
    table = tables["point.csv"]
    t, way = np.array(table["time_s"]), way_of(table)
    goal = np.stack([table["goal_x_m"], table["goal_y_m"]], axis=1)
    told = not numbers["events"]  # the goal is measured all the time

    def draw(panels):
        panels[0].plot(*way.T, color=colour(1), label="way")
        points(panels[0], way[:1], "#555555", "start")
        if not told:
            panels[0].plot(*np.stack([way[0], goal[0]]).T, "--", color="#999999", linewidth=1, label="straight on")
            points(panels[0], goal[-1:], colour(0), "goal")
        events = [int(np.argmin(np.abs(t - event["time_s"]))) for event in numbers["events"]]
        points(panels[0], way[events], colour(2), "where it changed")
        points(panels[0], [event["via_m"] for event in numbers["events"] if event["via_m"]], colour(4), "via")
        place_axes(panels[0])
        for i, axis in enumerate("xy"):
            panels[1].plot(
                *runs.thinned(t, goal[:, i]), color=colour(i), alpha=0.4, linewidth=1, label=f"goal {axis} as given"
            )
            panels[1].plot(*runs.thinned(t, way[:, i]), color=colour(i), label=axis)
        panels[2].plot(
            *runs.thinned(t, np.hypot(table["vx_mps"], table["vy_mps"])), color=colour(0), label="norm over both axes"
        )
        panels[3].plot(
            *runs.thinned(t, np.hypot(table["ax_mps2"], table["ay_mps2"])), color=colour(0), label="norm over both axes"
        )
        for axes, name in zip(panels[2:], ("max_speed_mps", "max_acceleration_mps2")):
            if numbers[name] is not None:
                runs.level(axes, numbers[name], "bound")
        for axes, name in zip(panels[1:], ("place (m)", "speed (m/s)", "acceleration (m/s²)")):
            axes.set(xlabel="time (s)", ylabel=name)
            legend_above(axes)

    return Figure(draw, 4, 2.3, shared=False)


def arm_figure(numbers, tables):
    """Figures 8.8 and 8.10: the tool of the arm in a horizontal plane."""
    table = tables["samples.csv"]
    t, tool, wanted = np.array(table["time_s"]), runs.places_of(table)[:, :2], runs.places_of(table, "wanted")[:, :2]

    def draw(panels):
        panels[0].plot(*tool.T, color=colour(1), label="true")
        panels[0].plot(*wanted.T, "--", color=colour(0), label="planned")
        panels[0].plot(
            *np.stack([tool[0], numbers["events"][0]["goal_m"]]).T,
            "--",
            color="#999999",
            linewidth=1,
            label="straight on",
        )
        events = [int(np.argmin(np.abs(t - event["time_s"]))) for event in numbers["events"][1:]]
        points(panels[0], tool[events], colour(2), "where it changed")
        points(panels[0], [numbers["events"][-1]["goal_m"]], "#000000", "goal")
        points(panels[0], [event["via_m"] for event in numbers["events"] if event["via_m"]], colour(4), "via")
        place_axes(panels[0])
        for axes, key, name in zip(
            panels[1:], ("commanded_speed_mps", "commanded_acceleration_mps2"), ("speed (m/s)", "acceleration (m/s²)")
        ):
            axes.plot(*runs.thinned(t, table[key]), color=colour(0), label="commanded tool")
            axes.set(xlabel="time (s)", ylabel=name)
        runs.level(panels[1], numbers["max_speed_mps"], "bound")
        for axes in panels[1:]:
            legend_above(axes)

    return Figure(draw, 3, 2.4, shared=False)


def figure(numbers, tables):
    """The figure of a replica. numbers: of its summary; tables: its CSV files by name. Raises StopIteration for other tables."""
    kind = next(kind for name, kind in KINDS.items() if name in tables)
    return {"field": field_figure, "point": point_figure, "arm": arm_figure}[kind](numbers, tables)


CAPTIONS = {
    "field-strict.csv": "The ways with strict (top) and mild (middle) parameters, and the weights. The circle is where the weight has fallen by half.",
    "point.csv": "Way, place, speed and acceleration of the point as commanded at 1 kHz.",
    "samples.csv": "Way, speed and acceleration of the tool. Planned: of the trajectory; true: of the arm, whose drives follow with an error.",
}


def add_arm(page, result):
    arm, data, table = result.json("arm.json"), result.json("scene.json"), result.table("samples.csv")
    part, missing = view3d.arm_of(arm, result.folder)
    objects, gone = view3d.objects_of(data, result.folder)
    run = runs.run_of(table, arm, result.name, colour(1))
    page.view(
        view3d.scene([part], [run], [*objects, *runs.marks_of(table)], data["ground"]),
        "The arm: press Play, or move the slider. Line: the way of the tool; grey ball: start; black ball: goal. The "
        "grid has squares of 10 cm.",
    )
    page.items(missing + gone)
    if result.summary["replica"] in ("fig8.11", "fig8.12"):
        add_snapshots(page, result, arm, part, table, data)


def add_snapshots(page, result, arm, part, table, data):
    """The arm at times spread over its motion, beside each other."""
    numbers, t, q = result.summary["numbers"], np.array(table["time_s"]), runs.joints_of(table, arm)
    end = max(numbers["metrics"]["duration_s"], numbers["motion_begins_s"])
    taken = [int(np.argmin(np.abs(t - time))) for time in np.linspace(numbers["motion_begins_s"], end, SNAPSHOTS)]
    rows = [
        {
            "name": f"{number(t[i])} s",
            "colour": colour(k),
            "arm": 0,
            "t": [0],
            "q": [q[i].tolist()],
            "base": view3d.base_at(view3d.beside(0.5 * k)),
        }
        for k, i in enumerate(taken)
    ]
    page.view(
        view3d.scene([part], rows, [], data["ground"]),
        f"Snapshots, from left to right at {', '.join(row['name'] for row in rows)}. Drag to turn, the wheel or two "
        "fingers to zoom.",
    )


def page(results):
    first = results[0].summary
    page = Page(f"Replica of figure {first['replica'].removeprefix('fig')}", f"{first['title']}.")
    several = len(results) > 1
    for result in results:
        page.answers(
            *(f"{result.name}: {sentence}" if several else sentence for sentence in result.summary["findings"])
        )
    for result in results:
        summary = result.summary
        page.section(f"Result of {result.name}" if several else "What came out")
        page.table(
            ["", "thesis", "here", "agrees"],
            [[c["what"], c["thesis"], c["here"], c["agrees"]] for c in summary["comparisons"]],
            "The thesis's values beside ours; what it does not tell cannot disagree.",
        )
        tables = {name: result.table(name) for name in result.files() if name.endswith(".csv")}
        kind = next(name for name in KINDS if name in tables)
        page.figure(
            figure(summary["numbers"], tables), f"{summary['replica']}-{result.name}", summary["title"], CAPTIONS[kind]
        )
        if kind == "samples.csv":
            add_arm(page, result)
    page.section("What was chosen here")
    page.items(first["choices"])
    page.section("How it was made")
    page.facts([(result.name, result.summary["command_line"]) for result in results])
    return page
