# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-print-pattern --explore: which camera, controller and velocity give which accuracy, throughput and load."""
import numpy as np

from .page import Cell, Page, number
from .plots import COLOURS, Figure, legend_above, logarithmic

MOST_ROWS = 60  # of the front's table; front.csv has all
MOST_CLASSES = 8  # of a variable
VARIABLES = [
    ("frame rate (Hz)", lambda d: d["frame_rate_hz"], lambda d: number(d["frame_rate_hz"], 4)),
    ("image (px)", lambda d: d["width_px"] * d["height_px"], lambda d: f"{d['width_px']:.0f} × {d['height_px']:.0f}"),
    ("magnification (µm/px)", lambda d: d["um_per_px"], lambda d: number(d["um_per_px"])),
    ("exposure (µs)", lambda d: d["exposure_us"], lambda d: number(d["exposure_us"])),
    ("controller", lambda d: d["controller"], lambda d: d["controller"]),
    ("velocity at the drops (mm/s)", lambda d: d["drop_velocity_mm_s"], lambda d: number(d["drop_velocity_mm_s"])),
    ("mean velocity over that at the drops", lambda d: d["speed_up"], lambda d: number(d["speed_up"])),
]
COLUMNS = [
    "design",
    "frame rate (Hz)",
    "image (px)",
    "µm/px",
    "exposure (µs)",
    "controller",
    "velocity at drops / mean (mm/s)",
    "delay (frames)",
    "a cell is seen to (µm)",
    "95 % land within (µm)",
    "worst (µm)",
    "cells/s",
    "load (% of a core)",
    "",
]


def designs_of(result):
    table = result.table("explore.csv")
    return [dict(zip(table, row)) for row in zip(*table.values())]


def text_of(d):
    return (
        f"{number(d['frame_rate_hz'], 4)} Hz, {d['width_px']:.0f} × {d['height_px']:.0f} px, {number(d['um_per_px'])} µm/px, "
        f"{number(d['exposure_us'])} µs, {d['controller']}, {number(d['drop_velocity_mm_s'])} mm/s"
    )


def row_of(d, best):
    values = [
        int(d["design"]),
        Cell(d["frame_rate_hz"]),
        f"{d['width_px']:.0f} × {d['height_px']:.0f}",
        d["um_per_px"],
        d["exposure_us"],
        d["controller"],
        f"{number(d['drop_velocity_mm_s'])} / {number(d['drop_velocity_mm_s'] * d['speed_up'])}",
        d["delay_frames"],
        d["sensor_x_um"],
        d["landing_p95_um"],
        d["landing_worst_um"],
        d["throughput_cells_per_s"],
        100 * d["load"],
        "thesis's camera" if d["thesis"] else "",
    ]
    cells = [value if isinstance(value, Cell) else Cell(value) for value in values]
    for cell in cells:
        cell.style += " best" if best else ""
    return cells


def front_figure(designs, summary, metrics, groups):
    y = summary["objectives"][0]
    x = summary["objectives"][min(1, len(summary["objectives"]) - 1)]

    def draw(panels):
        axes = panels[0]
        for label, colour, members in groups:
            if members:
                axes.plot(
                    [d[x] for d in members], [d[y] for d in members], "o", markersize=3, color=colour, label=label
                )
        best = summary.get("best", {}).get("design", -1)
        rings = [
            ("Pareto front", "#000000", 6, [d for d in designs if d["front"]]),
            ("thesis's camera", COLOURS[1], 9, [d for d in designs if d["thesis"] and d["feasible"]]),
            ("best compromise", COLOURS[3], 11, [d for d in designs if d["design"] == best]),
        ]
        for label, colour, size, members in rings:
            if members:
                axes.plot(
                    [d[x] for d in members],
                    [d[y] for d in members],
                    "o",
                    markersize=size,
                    markerfacecolor="none",
                    markeredgecolor=colour,
                    markeredgewidth=1.2,
                    label=label,
                )
        axes.set(xlabel=metrics[x]["text"], ylabel=metrics[y]["text"])
        logarithmic(axes.yaxis)
        legend_above(axes, 6)

    return Figure(draw, height=3.6)


def by_load(feasible):
    """Thirds of the designs, light to dark."""
    loads, groups, low = sorted(d["load"] for d in feasible), [], -1.0
    for i, colour in enumerate(("#9ecae1", "#4292c6", "#08306b")):
        high = loads[(len(loads) - 1) * (i + 1) // 3]
        if high > low:
            groups.append(
                (f"load up to {number(100 * high, 2)} %", colour, [d for d in feasible if low < d["load"] <= high])
            )
            low = high
    return groups


def classes_of(designs, value):
    """A class for each value, or eighths of the designs where there are many."""
    values = sorted(value(d) for d in designs)
    different = sorted(set(values))
    if len(different) <= MOST_CLASSES:
        return {v: i for i, v in enumerate(different)}
    return {v: values.index(v) * MOST_CLASSES // len(values) for v in different}


def influence_figure(designs, objective, metric):
    shown = [variable for variable in VARIABLES if len({variable[1](d) for d in designs}) > 1] or VARIABLES[:1]

    def draw(panels):
        for axes, (text, value, name) in zip(panels, shown):
            classes, names, members = classes_of(designs, value), {}, {}
            for d in sorted(designs, key=value):
                k = classes[value(d)]
                names[k] = (names.get(k, (name(d),))[0], name(d))
                if d["feasible"]:
                    members.setdefault(k, []).append(d[objective])
            for k, values in members.items():
                aside = 0.05 * (np.arange(len(values)) % 9 - 4)
                axes.plot(
                    k + aside,
                    values,
                    ".",
                    color="#9ecae1",
                    markersize=3,
                    label="designs that work" if k == min(members) else None,
                )
            order = sorted(members)
            axes.plot(
                order, [np.median(members[k]) for k in order], "o-", color=COLOURS[0], markersize=3, label="median"
            )
            best = max if metric["more"] else min
            axes.plot(order, [best(members[k]) for k in order], "o-", color=COLOURS[1], markersize=3, label="best")
            ticks = sorted(names)
            axes.set(ylabel=metric["text"], xlabel=text, xticks=ticks, xlim=(-0.5, max(ticks) + 0.5))
            logarithmic(axes.yaxis)
            axes.set_xticklabels([a if a == b else f"{a} to {b}" for a, b in (names[k] for k in ticks)])
        legend_above(panels[0])

    return Figure(draw, len(shown), 2.1, shared=False)


def camera_figure(designs, setup):
    def draw(panels):
        axes, works = panels[0], {}
        for d in designs:
            key = (d["frame_rate_hz"], d["width_px"] * d["height_px"])
            works[key] = works.get(key, False) or bool(d["feasible"])
        for good, colour, label in ((False, "#c3c8ce", "none works"), (True, COLOURS[0], "at least one design works")):
            members = [key for key, value in works.items() if value == good]
            if members:
                axes.plot(*zip(*members), "o", markersize=4, color=colour, label=label)
        axes.plot(
            [1600],
            [160 * 100],
            "o",
            markersize=9,
            markerfacecolor="none",
            markeredgecolor=COLOURS[1],
            label="thesis's camera",
        )
        rates = np.array([rate for rate, _ in works])
        shortest = min(d["exposure_us"] for d in designs)
        rate = np.geomspace(0.8 * rates.min(), 1.25 * rates.max(), 100)
        left = 1e6 / rate - (0 if setup["overlap"] else shortest)
        axes.plot(
            rate[left > 0],
            (left * setup["pixel_rate_mpx_s"])[left > 0],
            color=COLOURS[1],
            label=f"readout, exposure of {number(shortest)} µs",
        )
        axes.plot(rate, setup["link_mb_s"] * 1e6 / rate, "--", color=COLOURS[2], label="link")
        axes.set(xlabel="frame rate (Hz)", ylabel="image size (px)")
        logarithmic(axes.xaxis, axes.yaxis)
        legend_above(axes, 5)

    return Figure(draw, height=3.2)


def add_result(page, result):
    summary, setup, designs = result.summary, result.json("setup.json"), designs_of(result)
    feasible, metrics = [d for d in designs if d["feasible"]], setup["metrics"]
    objective = summary["objectives"][0]
    if feasible:
        page.section("Accuracy, throughput and load")
        names = ("pid", "pid-ff", "observer")
        groups = [(name, COLOURS[i], [d for d in feasible if d["controller"] == name]) for i, name in enumerate(names)]
        page.figure(
            front_figure(designs, summary, metrics, groups),
            "front-controller",
            "Designs that work, by controller, with the Pareto front",
            "Each point is a design that works. Rings: it keeps what is required, and no other such design is better in one objective and as "
            "good in all others; where a ring lies behind others in this plane, it needs less of another objective.",
        )
        page.figure(
            front_figure(designs, summary, metrics, by_load(feasible)),
            "front-load",
            "The same designs, by computing load",
            "The same, darker for more computing.",
        )
        page.section("What each variable does")
        page.figure(
            influence_figure(designs, objective, metrics[objective]),
            "influence",
            "The first objective against each variable, best and median of the designs that work",
            "Designs that work at each value of a variable, all others being whatever they are. A value without points: no design works "
            "with it. The line of the best is what can be had with the best choice of all others.",
        )
    page.section("Frame rate against image size")
    page.figure(
        camera_figure(designs, setup),
        "cameras",
        "Image size against frame rate with the limits of camera and link",
        "(7.2) and figure 7.1. Above the solid line the camera cannot read out an image before the next one, above the dashed one the link "
        "cannot carry it. A grey point below both has another reason: too few cells in view, cells missed, the tracker.",
    )
    front = sorted((d for d in designs if d["front"]), key=lambda d: d[objective], reverse=metrics[objective]["more"])
    if front:
        page.section("The Pareto front")
        best = summary.get("best", {}).get("design", -1)
        more = f" The first {MOST_ROWS} of {len(front)}; front.csv has all." if len(front) > MOST_ROWS else ""
        page.table(
            COLUMNS,
            [row_of(d, d["design"] == best) for d in front[:MOST_ROWS]],
            f"Designs that keep what is required and that no other such one beats in one of {', '.join(summary['objectives'])} and equals in the "
            "others. Marked: the best compromise, nearest to the best of each objective with each scaled to its range over the front."
            + more,
        )
    thesis = [d for d in feasible if d["thesis"]]
    if thesis:
        page.section("The thesis's camera")
        page.table(
            COLUMNS,
            [row_of(d, False) for d in thesis],
            "1600 Hz, 160 × 100 px, 4.5 µm/px, 50 µs, 28.8 mm/s at the centres, here with vpPatternTracker.",
        )
    page.section("What does not work, and why")
    rows = []
    for kind, count in summary["infeasible"].items():
        example = next(d for d in designs if d["reason"] == kind)
        rows.append([kind, count, setup["meanings"].get(kind, kind), f"{text_of(example)}: {example['sentence']}"])
    page.table(
        ["reason", "designs", "", "for instance"],
        [*rows, ["none: they work", len(feasible), "", ""]],
        "The first reason that is met counts, in the order camera, link, processor, view, delay; then what the simulation shows. explore.csv "
        "has the reason of each design.",
    )
    return setup


def page(results):
    page = Page(
        "Exploring the design space of printing",
        f"{results[0].summary['name']}: which camera, controller and velocity give which accuracy, throughput and load.",
    )
    setups = []
    for result in results:
        page.answers(
            *((f"{result.name}: " if len(results) > 1 else "") + sentence for sentence in result.summary["findings"])
        )
    for result in results:
        setups.append(add_result(page, result))
    page.section("What to know")
    page.items(
        [
            "A design is judged by a few runs: differences of a tenth of a landing error are chance. The front has the lucky ones among nearly "
            "equal designs; look at its neighbours before you buy.",
            "Drops fly straight and always alike, encoders and vibrations are not modelled, so landing errors are those of vision, control and "
            "timing alone.",
            "The computing load is a model with constants measured on one machine. It is the same on every machine that explores.",
            "The controllers' gains are not optimised for each design: they follow from the thesis's by the loop's delay (pid, pid-ff) or are "
            "the same in seconds (observer).",
        ]
    )
    page.section("What was explored")
    page.paragraph(
        "The same product, stage and print head under each camera: stage and product are described in µm and seconds and changed to the px "
        "and frames of the camera. The camera's pictures are rendered with its magnification, exposure (motion blur, and fewer photons "
        "when shorter) and noise, and measured by vpPatternTracker; the loop is closed through them."
    )
    for result, setup in zip(results, setups):
        page.facts([*setup["facts"].items(), ("command", result.summary["command"])])
    return page
