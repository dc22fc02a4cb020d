# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Replicas of figures 8.6 to 8.13 of the thesis by visp-avoid-obstacle --replica."""
import numpy as np

from . import runs, view3d
from .page import Page, number
from .plots import colour, figure, legend_above

SNAPSHOTS = 6


def way_of(table):
    return np.stack([table["x_m"], table["y_m"]], axis=1)


def place_axes(axes):
    axes.set_aspect("equal", "datalim")
    legend_above(axes, 3, xlabel="x (m)", ylabel="y (m)")


def points(axes, places, shade, label):
    if len(places):
        axes.plot(*np.array(places).T, "o", color=shade, markersize=4, label=label)


def straight_on(axes, start, end):
    axes.plot(*np.stack([start, end]).T, "--", color="#999999", linewidth=1, label="straight on")


def changes(axes, events, t, way):
    points(axes, way[[int(np.argmin(np.abs(t - event["time_s"]))) for event in events]], colour(2), "where it changed")


def vias(axes, events):
    points(axes, [event["via_m"] for event in events if event["via_m"]], colour(4), "via")


@figure(3, 3.0, shared=False)
def field_figure(panels, numbers, tables):
    """Figure 8.6: ways through a potential field with strict and mild parameters."""
    strict, mild, alone = (tables[f"field-{name}.csv"] for name in ("strict", "mild", "alone"))
    turn, middle = np.linspace(0, 2 * np.pi, 90), np.array(numbers["obstacle_m"])[:, None]
    for axes, table, name, shade in zip(panels, (strict, mild), ("strict", "mild"), (colour(1), colour(0))):
        axes.plot(*way_of(table).T, color=colour(1), label=f"way, {name} parameters")
        axes.plot(*way_of(alone).T, "--", color="#999999", linewidth=1, label="without obstacle")
        points(axes, numbers["places_m"], colour(0), "vias and end")
        points(axes, [numbers["obstacle_m"]], "#000000", "obstacle")
        circle = np.stack([np.cos(turn), np.sin(turn)]) * numbers[name]["d0_m"] + middle
        axes.plot(*circle, "--", color="#000000", linewidth=0.8, label="half the weight")
        place_axes(axes)
        panels[2].plot(table["time_s"], table["weight"], color=shade, label=name)
    legend_above(panels[2], xlabel="time (s)", ylabel="weight of avoidance")


@figure(4, 2.3, shared=False)
def point_figure(panels, numbers, tables):
    """Figures 8.7, 8.9 and 8.13: a point in the plane."""
    table, events = tables["point.csv"], numbers["events"]
    t, way = np.array(table["time_s"]), way_of(table)
    goal = np.stack([table["goal_x_m"], table["goal_y_m"]], axis=1)
    panels[0].plot(*way.T, color=colour(1), label="way")
    points(panels[0], way[:1], "#555555", "start")
    if events:  # else the goal is measured all the time
        straight_on(panels[0], way[0], goal[0])
        points(panels[0], goal[-1:], colour(0), "goal")
    changes(panels[0], events, t, way)
    vias(panels[0], events)
    place_axes(panels[0])
    for i, axis in enumerate("xy"):
        panels[1].plot(*runs.thinned(t, goal[:, i]), color=colour(i), alpha=0.4, linewidth=1, label=f"goal {axis} as given")
        panels[1].plot(*runs.thinned(t, way[:, i]), color=colour(i), label=axis)
    for axes, pair, bound in zip(panels[2:], ("v{}_mps", "a{}_mps2"), ("max_speed_mps", "max_acceleration_mps2")):
        norm = np.hypot(*(table[pair.format(axis)] for axis in "xy"))
        axes.plot(*runs.thinned(t, norm), color=colour(0), label="norm over both axes")
        if numbers[bound] is not None:
            runs.level(axes, numbers[bound], "bound")
    for axes, name in zip(panels[1:], ("place (m)", "speed (m/s)", "acceleration (m/s²)")):
        legend_above(axes, xlabel="time (s)", ylabel=name)


@figure(3, 2.4, shared=False)
def arm_figure(panels, numbers, tables):
    """Figures 8.8 and 8.10: the tool of the arm in a horizontal plane."""
    table, events = tables["samples.csv"], numbers["events"]
    t, tool, wanted = np.array(table["time_s"]), runs.places_of(table)[:, :2], runs.places_of(table, "wanted")[:, :2]
    panels[0].plot(*tool.T, color=colour(1), label="true")
    panels[0].plot(*wanted.T, "--", color=colour(0), label="planned")
    straight_on(panels[0], tool[0], events[0]["goal_m"])
    changes(panels[0], events[1:], t, tool)
    points(panels[0], [events[-1]["goal_m"]], "#000000", "goal")
    vias(panels[0], events)
    place_axes(panels[0])
    for axes, key in zip(panels[1:], ("commanded_speed_mps", "commanded_acceleration_mps2")):
        axes.plot(*runs.thinned(t, table[key]), color=colour(0), label="commanded tool")
    runs.level(panels[1], numbers["max_speed_mps"], "bound")
    for axes, name in zip(panels[1:], ("speed (m/s)", "acceleration (m/s²)")):
        legend_above(axes, xlabel="time (s)", ylabel=name)


KINDS = {  # by a table that is only there for this kind
    "field-strict.csv": (
        field_figure,
        "The ways with strict (top) and mild (middle) parameters, and the weights. The circle is where the weight has fallen by half.",
    ),
    "point.csv": (point_figure, "Way, place, speed and acceleration of the point as commanded at 1 kHz."),
    "samples.csv": (
        arm_figure,
        "Way, speed and acceleration of the tool. Planned: of the trajectory; true: of the arm, whose drives follow with an error.",
    ),
}


def add_arm(page, result):
    run = runs.Logged(result)
    part, moves, objects, missing = run.shown(colour(1))
    page.view(
        view3d.scene([part], [moves], objects, run.scene["ground"]),
        "The arm: press Play, or move the slider. Line: the way of the tool; grey ball: start; black ball: goal. The "
        "grid has squares of 10 cm.",
    )
    page.items(*missing)
    if result.summary["replica"] in ("fig8.11", "fig8.12"):
        add_snapshots(page, run, part)


def add_snapshots(page, run, part):
    """The arm at times spread over its motion, beside each other."""
    numbers, t, q = run.result.summary["numbers"], np.array(run.table["time_s"]), runs.joints_of(run.table, run.arm)
    end = max(numbers["metrics"]["duration_s"], numbers["motion_begins_s"])
    taken = [int(np.argmin(np.abs(t - time))) for time in np.linspace(numbers["motion_begins_s"], end, SNAPSHOTS)]
    rows = []
    for k, i in enumerate(taken):
        base = view3d.base_at(view3d.beside(0.5 * k))
        rows.append({"name": f"{number(t[i])} s", "colour": colour(k), "arm": 0, "t": [0], "q": [q[i].tolist()], "base": base})
    page.view(
        view3d.scene([part], rows, [], run.scene["ground"]),
        f"Snapshots, from left to right at {', '.join(row['name'] for row in rows)}. Drag to turn, the wheel or two fingers to zoom.",
    )


def page(results):
    first = results[0].summary
    page = Page(f"Replica of figure {first['replica'].removeprefix('fig')}", f"{first['title']}.", results)
    for result in results:
        summary = result.summary
        page.section("What came out", f"Result of {result.name}")
        says = "The thesis's values beside ours; what it does not tell cannot disagree."
        page.records(summary["comparisons"], [("", "what"), "thesis; here; agrees"], says)
        tables = {name: result.table(name) for name in result.files() if name.endswith(".csv")}
        draw, caption = next(KINDS[name] for name in KINDS if name in tables)
        page.figure(draw(summary["numbers"], tables).named(f"{summary['replica']}-{result.name}", summary["title"]), caption)
        if draw is arm_figure:
            add_arm(page, result)
    page.section("What was chosen here")
    page.items(*first["choices"])
    page.section("How it was made")
    page.facts([(result.name, result.summary["command_line"]) for result in results])
    return page
