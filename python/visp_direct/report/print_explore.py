# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-print-pattern --explore: which camera, controller and velocity give which accuracy, throughput and load."""
import numpy as np

from .page import Page, number
from .plots import COLOURS, Figure, figure, legend_above, logarithmic

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
    ("design", lambda d: int(d["design"])),
    "frame rate (Hz) = frame_rate_hz",
    ("image (px)", lambda d: f"{d['width_px']:.0f} × {d['height_px']:.0f}"),
    "µm/px = um_per_px; exposure (µs) = exposure_us; controller",
    ("velocity at drops / mean (mm/s)", lambda d: " / ".join(number(d["drop_velocity_mm_s"] * k) for k in (1, d["speed_up"]))),
    "delay (frames) = delay_frames; a cell is seen to (µm) = sensor_x_um; 95 % land within (µm) = landing_p95_um; worst (µm) = "
    "landing_worst_um; cells/s = throughput_cells_per_s; load (% of a core) = 100 load",
    ("", lambda d: "thesis's camera" if d["thesis"] else ""),
]


def text_of(d):
    return (
        f"{number(d['frame_rate_hz'], 4)} Hz, {d['width_px']:.0f} × {d['height_px']:.0f} px, {number(d['um_per_px'])} µm/px, "
        f"{number(d['exposure_us'])} µs, {d['controller']}, {number(d['drop_velocity_mm_s'])} mm/s"
    )


@figure(height=3.6)
def front_figure(axes, designs, summary, metrics, groups):
    y = summary["objectives"][0]
    x = summary["objectives"][min(1, len(summary["objectives"]) - 1)]

    def circles(members, size, label, **style):
        if members:
            axes.plot([d[x] for d in members], [d[y] for d in members], "o", markersize=size, label=label, **style)

    for label, colour, members in groups:
        circles(members, 3, label, color=colour)
    best = summary.get("best", {}).get("design", -1)
    rings = [
        ("Pareto front", "#000000", 6, [d for d in designs if d["front"]]),
        ("thesis's camera", COLOURS[1], 9, [d for d in designs if d["thesis"] and d["feasible"]]),
        ("best compromise", COLOURS[3], 11, [d for d in designs if d["design"] == best]),
    ]
    for label, colour, size, members in rings:
        circles(members, size, label, markerfacecolor="none", markeredgecolor=colour, markeredgewidth=1.2)
    axes.set(xlabel=metrics[x]["text"], ylabel=metrics[y]["text"])
    logarithmic(axes.yaxis)
    legend_above(axes, 6)


def by_load(feasible):
    """Thirds of the designs, light to dark."""
    loads, groups, low = sorted(d["load"] for d in feasible), [], -1.0
    for i, colour in enumerate(("#9ecae1", "#4292c6", "#08306b")):
        high = loads[(len(loads) - 1) * (i + 1) // 3]
        if high > low:
            members = [d for d in feasible if low < d["load"] <= high]
            groups.append((f"load up to {number(100 * high, 2)} %", colour, members))
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
                label = "designs that work" if k == min(members) else None
                axes.plot(k + aside, values, ".", color="#9ecae1", markersize=3, label=label)
            order = sorted(members)
            for choice, colour, label in ((np.median, COLOURS[0], "median"), (max if metric["more"] else min, COLOURS[1], "best")):
                axes.plot(order, [choice(members[k]) for k in order], "o-", color=colour, markersize=3, label=label)
            ticks = sorted(names)
            axes.set(ylabel=metric["text"], xlabel=text, xticks=ticks, xlim=(-0.5, max(ticks) + 0.5))
            logarithmic(axes.yaxis)
            axes.set_xticklabels([a if a == b else f"{a} to {b}" for a, b in (names[k] for k in ticks)])
        legend_above(panels[0])

    return Figure(draw, len(shown), 2.1, shared=False)


@figure(height=3.2)
def camera_figure(axes, designs, setup):
    works = {}
    for d in designs:
        key = (d["frame_rate_hz"], d["width_px"] * d["height_px"])
        works[key] = works.get(key, False) or bool(d["feasible"])
    for good, colour, label in ((False, "#c3c8ce", "none works"), (True, COLOURS[0], "at least one design works")):
        members = [key for key, value in works.items() if value == good]
        if members:
            axes.plot(*zip(*members), "o", markersize=4, color=colour, label=label)
    ring = {"markerfacecolor": "none", "markeredgecolor": COLOURS[1], "label": "thesis's camera"}
    axes.plot([1600], [160 * 100], "o", markersize=9, **ring)
    rates = np.array([rate for rate, _ in works])
    shortest = min(d["exposure_us"] for d in designs)
    rate = np.geomspace(0.8 * rates.min(), 1.25 * rates.max(), 100)
    left = 1e6 / rate - (0 if setup["overlap"] else shortest)
    pixels = (left * setup["pixel_rate_mpx_s"])[left > 0]
    axes.plot(rate[left > 0], pixels, color=COLOURS[1], label=f"readout, exposure of {number(shortest)} µs")
    axes.plot(rate, setup["link_mb_s"] * 1e6 / rate, "--", color=COLOURS[2], label="link")
    logarithmic(axes.xaxis, axes.yaxis)
    legend_above(axes, 5, xlabel="frame rate (Hz)", ylabel="image size (px)")


def add_result(page, result):
    summary, setup, table = result.summary, result.json("setup.json"), result.table("explore.csv")
    designs = [dict(zip(table, row)) for row in zip(*table.values())]
    feasible, metrics = [d for d in designs if d["feasible"]], setup["metrics"]
    objective = summary["objectives"][0]
    if feasible:
        page.section("Accuracy, throughput and load")
        by_controller = "front-controller", "Designs that work, by controller, with the Pareto front"
        names = ("pid", "pid-ff", "observer")
        groups = [(name, COLOURS[i], [d for d in feasible if d["controller"] == name]) for i, name in enumerate(names)]
        page.figure(
            front_figure(designs, summary, metrics, groups).named(*by_controller),
            "Each point is a design that works. Rings: it keeps what is required, and no other such design is better in one objective and as "
            "good in all others; where a ring lies behind others in this plane, it needs less of another objective.",
        )
        page.figure(
            front_figure(designs, summary, metrics, by_load(feasible)).named("front-load", "The same designs, by computing load"),
            "The same, darker for more computing.",
        )
        page.section("What each variable does")
        influence = influence_figure(designs, objective, metrics[objective])
        page.figure(
            influence.named("influence", "The first objective against each variable, best and median of the designs that work"),
            "Designs that work at each value of a variable, all others being whatever they are. A value without points: no design works "
            "with it. The line of the best is what can be had with the best choice of all others.",
        )
    page.section("Frame rate against image size")
    page.figure(
        camera_figure(designs, setup).named("cameras", "Image size against frame rate with the limits of camera and link"),
        "(7.2) and figure 7.1. Above the solid line the camera cannot read out an image before the next one, above the dashed one the link "
        "cannot carry it. A grey point below both has another reason: too few cells in view, cells missed, the tracker.",
    )
    front = sorted((d for d in designs if d["front"]), key=lambda d: d[objective], reverse=metrics[objective]["more"])
    if front:
        page.section("The Pareto front")
        best = summary.get("best", {}).get("design", -1)
        more = f" The first {MOST_ROWS} of {len(front)}; front.csv has all." if len(front) > MOST_ROWS else ""
        page.records(
            front[:MOST_ROWS],
            COLUMNS,
            f"Designs that keep what is required and that no other such one beats in one of {', '.join(summary['objectives'])} and equals in the "
            f"others. Marked: the best compromise, nearest to the best of each objective with each scaled to its range over the front.{more}",
            lambda d: d["design"] == best,
        )
    thesis = [d for d in feasible if d["thesis"]]
    if thesis:
        page.section("The thesis's camera")
        says = "1600 Hz, 160 × 100 px, 4.5 µm/px, 50 µs, 28.8 mm/s at the centres, here with vpPatternTracker."
        page.records(thesis, COLUMNS, says)
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
        results,
    )
    setups = [add_result(page, result) for result in results]
    page.section("What to know")
    page.items(
        "A design is judged by a few runs: differences of a tenth of a landing error are chance. The front has the lucky ones among nearly "
        "equal designs; look at its neighbours before you buy.",
        "Drops fly straight and always alike, encoders and vibrations are not modelled, so landing errors are those of vision, control and "
        "timing alone.",
        "The computing load is a model with constants measured on one machine. It is the same on every machine that explores.",
        "The controllers' gains are not optimised for each design: they follow from the thesis's by the loop's delay (pid, pid-ff) or are "
        "the same in seconds (observer).",
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
