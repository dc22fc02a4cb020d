# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-thesis-report: each value of the thesis beside ours, and what the comparison can say."""
from collections import Counter

import numpy as np

from .page import Cell, Page, counted, number
from .plots import Figure, legend_above, logarithmic

CURVE_POINTS = 700  # of a curve; more cannot be seen
LEGEND = 125  # letters in a row
COULD_FAIL = ("value", "bound", "arithmetic")
KINDS = {
    "value": "values, which could be missed on both sides",
    "bound": "bounds and claims of an order, which could be missed on one side",
    "arithmetic": "numbers that follow from others of the thesis",
}
VERDICTS = ("agrees", "better", "differs", "by construction", "not comparable")
STYLES = {"differs": "text worst", "better": "text best"}


def value_text(value, unit):
    return number(value, 4) + (f" {unit}" if unit != "1" and value is not None else "")


def thesis_text(row):
    sign = {"at most": "≤ ", "at least": "≥ "}
    kind = next((sign[k] for k in sign if (row["tolerance"] or "").startswith(k)), "")
    return kind + value_text(row["thesis"], row["unit"])


def ours_text(row):
    spread = "" if row["spread"] is None else f" ± {number(row['spread'], 2)}"
    return number(row["ours"], 4) + spread + (f" {row['unit']}" if row["unit"] != "1" and row["ours"] is not None else "")


def verdict_cell(row):
    if row["thesis"] is None:
        return Cell("–", "text")
    same = round(row["share_of_seeds"] * row["seeds"])
    return Cell(row["verdict"] + (f", {same}/{row['seeds']} seeds" if same < row["seeds"] else ""), STYLES.get(row["verdict"], "text"))


def remark(row):
    """How it was measured; why it is so, and what shows that; tolerance; place and words of the thesis."""
    parts = [row["note"], row["reason"], f"[{row['support'].replace('`', '')}]" if row["support"] else ""]
    if row["thesis"] is not None:
        kind = "" if row["kind"] in ("value", row["verdict"]) else f"{row['kind'].capitalize()}. "
        source = f" ({row['tolerance_from']})" if row["tolerance_from"] else ""
        parts += [f"{kind}Tolerance: {row['tolerance']}{source}.", f"{row['where']}: “{row['quote']}”."]
    return " ".join(filter(None, parts))


ROWS = [
    ("quantity", lambda row: Cell(row["quantity"], "text wrap")),
    ("thesis", lambda row: Cell(thesis_text(row), "text")),
    ("ours", lambda row: Cell(ours_text(row), "text")),
    ("verdict", verdict_cell),
    ("how it was measured, why it is so [what shows that]; the thesis's words", lambda row: Cell(remark(row), "text wrap")),
]


def verdicts_of(rows):
    count = Counter(row["verdict"] for row in rows)
    several = {"agrees": "agree", "differs": "differ"}
    return ", ".join(f"{count[v]} {several.get(v, v) if count[v] > 1 else v}" for v in VERDICTS if count[v])


def overview(page, items, rows):
    page.section("Overview")
    records = []
    for item in items:
        mine = [row for row in rows if row["id"] == item["id"]]
        could = [row["verdict"] for row in mine if row["kind"] in COULD_FAIL]
        others = verdicts_of([row for row in mine if row["verdict"] in VERDICTS[3:]])
        records.append([item["label"], Cell(item["title"], "text wrap"), len(could), could.count("differs"), Cell(others, "text")])
    page.table(
        ["in the thesis", "what it shows", "values and bounds that could have failed", "of them differ", "the others"],
        records,
        "A row that had the thesis's value as an input, or whose conditions are not known, is no agreement and not counted.",
    )


class Curves:
    """curves.csv by item, figure, panel and curve."""

    def __init__(self, table):
        self.x, self.y = np.array(table["x"]), np.array(table["y"])
        keys = list(zip(table["item"], table["figure"], table["panel"], table["curve"]))
        starts = [i for i, key in enumerate(keys) if i == 0 or key != keys[i - 1]]
        self.ranges = {keys[a]: slice(a, b) for a, b in zip(starts, starts[1:] + [len(keys)])}

    def of(self, *key):
        chosen = self.ranges.get(key, slice(0, 0))
        step = max(1, (chosen.stop - chosen.start) // CURVE_POINTS)
        return self.x[chosen][::step], self.y[chosen][::step]


MARKERS = {"points": {"linestyle": "", "marker": "."}, "rings": {"linestyle": "", "marker": "o", "fillstyle": "none"}}
LINES = {"solid": "-", "dashed": "--", "dotted": ":"}


def draw_panel(axes, panel, curves, key):
    for c, curve in enumerate(panel["curves"]):
        x, y = curves.of(*key, c)
        style = MARKERS.get(curve["style"]) or {"linestyle": LINES[curve["style"]], "linewidth": 0.75 * curve["width"]}
        size = {"markersize": 2 * curve["width"]} if curve["style"] in MARKERS else {}
        axes.plot(x, y, color=curve["colour"], label=curve["label"] or None, **style, **size)
    axes.set(xlabel=panel["x_label"], ylabel=panel["y_label"])
    logs = [axis for axis, wanted in ((axes.xaxis, panel["log_x"]), (axes.yaxis, panel["log_y"])) if wanted]
    if logs:
        logarithmic(*logs)
    if panel["x_range"]:
        axes.set_xlim(*panel["x_range"])
    if panel["categories"]:
        axes.set_xticks(range(len(panel["categories"])), panel["categories"])
    if panel["from_zero"]:
        axes.set_ylim(bottom=0)
    if panel["equal"]:
        axes.set_aspect("equal", adjustable="datalim")
    for mark in panel["marks"]:
        axes.axvline(mark["x"], color="#999999", linewidth=0.9, label=mark["label"])
    labels = axes.get_legend_handles_labels()[1]
    columns = max(1, min(5, LEGEND // (max(map(len, labels), default=1) + 8)))
    axes.set_title(panel["title"], loc="left", pad=6 + 15 * -(-len(labels) // columns), fontsize=9, fontweight="bold")
    legend_above(axes, columns)


def panels_figure(item, figure, curves):
    def draw(panels):
        for p, (axes, panel) in enumerate(zip(panels, figure["panels"])):
            draw_panel(axes, panel, curves, (item["id"], figure["name"], p))

    height = np.mean([panel["height_px"] for panel in figure["panels"]]) / 110
    return Figure(draw, rows=len(figure["panels"]), height=height, shared=False)


def add_item(page, result, item, rows, curves):
    page.heading(f"{item['label']}: {item['title']}")
    for remark in item["remarks"]:
        page.paragraph(remark)
    page.records(rows, ROWS)
    for figure in item["figures"]:
        caption = f"{figure['title']}. {figure['caption']}"
        if figure["picture"]:
            kind = "png" if figure["picture"].endswith("png") else "jpeg"
            page.picture(result.bytes(figure["picture"]), f"image/{kind}", figure["title"], caption)
        else:
            page.figure(panels_figure(item, figure, curves).named(f"{item['id']}-{figure['name']}", figure["title"]), caption)
    if item["parameters"]:
        page.facts([(p["name"], p["value"]) for p in item["parameters"]], "")


def answer(page, summary, rows):
    compared = [row for row in rows if row["kind"] in COULD_FAIL]
    page.answers(f"{counted(len(compared), 'row')} of the comparison could have failed: {verdicts_of(compared)}.")
    for kind, text in KINDS.items():
        mine = [row for row in compared if row["kind"] == kind]
        if mine:
            page.answers(f"{len(mine)} are {text}: {verdicts_of(mine)}.")
    others = [row for row in rows if row["verdict"] in VERDICTS[3:]]
    if others:
        page.answers(f"Not counted: {verdicts_of(others)}.")
    failed = [row for row in rows if row["kind"] == "by construction" and row["verdict"] == "differs"]
    if failed:
        page.answers(f"In {counted(len(failed), 'row')} more what was fitted or given does not come out.")
    shaky = [row for row in compared if row["share_of_seeds"] < 1]
    if summary["seeds"] > 1:
        said = f"in {counted(len(shaky), 'row')} not every seed gives the same verdict" if shaky else "every seed gives the same verdicts"
        page.answers(f"Values are medians of {summary['seeds']} seeds, worst ones where a bound must hold in every run; {said}.")
    missing = [row for row in rows if "Not explained" in row["reason"] or (row["reason"] and not row["support"])]
    if missing:
        page.answers(f"{counted(len(missing), 'reason')} lack a run or test that shows them.")


def differences(page, results):
    """Rows whose verdict is not the same in all results."""
    page.section("Verdicts of the results side by side")
    first = {(row["id"], row["quantity"]): row for row in results[0].json("results.json")}
    table, common = [], 0
    for result in results[1:]:
        for row in result.json("results.json"):
            other = first.get((row["id"], row["quantity"]))
            common += other is not None
            if other and other["verdict"] != row["verdict"]:
                both = other["ours"], other["verdict"], result.name, row["ours"], row["verdict"]
                table.append([row["id"], Cell(row["quantity"], "text wrap"), *both])
    if table:
        page.table(["in the thesis", "quantity", f"ours, {results[0].name}", "verdict", "result", "ours", "verdict"], table)
    page.paragraph(f"Of {counted(common, 'common row')} {len(table)} have another verdict. All below is {results[0].name}.")


def page(results):
    result = results[0]
    rows, items = result.json("results.json"), result.json("items.json")
    curves = Curves(result.table("curves.csv"))
    page = Page(
        "The thesis again",
        "Every figure and table with results of “Direct Methods for Vision-Based Robot Control” (R. Pieters, 2013), and what comes out here",
    )
    answer(page, result.summary, rows)
    if len(results) > 1:
        differences(page, results)
    overview(page, items, rows)
    differing = [{**row, "quantity": f"{row['id']}: {row['quantity']}"} for row in rows if row["verdict"] == "differs"]
    if differing:
        page.section("Where it differs")
        page.records(differing, ROWS, "The rows below with this verdict, together.")
    chapter = ""
    for item in items:
        if item["chapter"] != chapter:
            chapter = item["chapter"]
            page.section(chapter)
        add_item(page, result, item, [row for row in rows if row["id"] == item["id"]], curves)
    page.section("How to read it")
    page.items(
        "Verdicts follow from thesis, ours and tolerance alone. By construction: the thesis's value was an input of the run, or a parameter was chosen for it. "
        "Not comparable: what decides the value is not known or was another.",
        "≤ and ≥ are bounds or orders, of which only one side can fail. Ours is the median of the seeds ± their standard deviation (none: deterministic, or one "
        "seed); notes have the numbers of the first seed.",
        "The thesis was read in a transcription: words are quoted to be found again, and marks lost in it may look like errors of the author.",
        'In brackets: the command, the test (build/release/bin/catchNAME "case") or the row that shows a reason.',
        "results.json has every row, curves.csv what is drawn.",
    )
    page.section("How it was made")
    summary = result.summary
    seeds = f"{summary['seeds']}, from {summary['seed']} on in steps of 1000"
    page.facts(
        [*((key, summary[key]) for key in ("command", "version")), ("seeds", seeds), ("time", f"{number(summary['wall_time_s'])} s")]
    )
    return page
