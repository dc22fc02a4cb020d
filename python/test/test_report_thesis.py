# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-thesis-report: what is counted, what is shown of a row, results side by side."""
import json

import numpy as np
import pytest
from visp_direct.report import thesis_report
from visp_direct.report.data import DataError, read_results

ROW = {
    "id": "fig6.3",
    "unit": "rad/s",
    "kind": "value",
    "thesis": 0.5,
    "where": "Figure 6.3",
    "quote": "does not exceed",
    "ours": 0.4,
    "seeds": 10,
    "deterministic": False,
    "spread": 0.0123,
    "least": 0.3,
    "largest": 0.5,
    "ratio": 0.8,
    "tolerance": "within a factor 1.1",
    "tolerance_from": "convention",
    "share_of_seeds": 1,
    "note": "noted",
    "reason": "",
    "support": "",
}
OWED = {"reason": "because", "support": '`catchNothing`, "case"'}


def row(quantity, verdict, **other):
    return {**ROW, "quantity": quantity, "verdict": verdict, **other}


ROWS = [
    row("a", "agrees"),
    row("b", "differs", share_of_seeds=0.9, **OWED),
    row("c", "agrees", kind="bound", tolerance="at most"),
    row("d", "by construction", kind="by construction", **OWED),
    row("e", "not comparable", kind="not comparable", **OWED),
    row("f", "no value in the thesis", kind="ours only", thesis=None, tolerance=None, where="", quote="", ratio=None, spread=None, least=None, largest=None, deterministic=True),
]
PANEL = {
    "title": "Velocity",
    "x_label": "time (s)",
    "y_label": "velocity",
    "x_range": [0, 2],
    "log_x": False,
    "log_y": True,
    "from_zero": False,
    "equal": False,
    "height_px": 300,
    "categories": [],
    "marks": [{"x": 1, "label": "event"}],
    "curves": [{"label": style, "colour": "#123456", "style": style, "width": 2} for style in ("solid", "points", "rings", "dashed", "dotted")],
}
ITEM = {
    "id": "fig6.3",
    "label": "Figure 6.3",
    "title": "goal moved",
    "chapter": "Chapter 6: x",
    "verdict": "differs",
    "remarks": ["remarked"],
    "parameters": [{"name": "cycle", "value": "1 ms"}],
    "figures": [{"name": "motion", "title": "Motion", "caption": "drawn", "picture": None, "panels": [PANEL, {**PANEL, "log_y": False, "equal": True}]}],
}


@pytest.fixture
def folder(tmp_path):
    def write(name, rows):
        out = tmp_path / name
        out.mkdir()
        summary = {"program": "visp-thesis-report", "version": "1", "command": "c", "seed": 1, "seeds": 10, "rows": {}, "could_fail": {}, "items": {}}
        (out / "summary.json").write_text(json.dumps({**summary, "verdicts": {}, "seconds_of_parts": {}, "jobs": 0, "wall_time_s": 1.0}))
        (out / "results.json").write_text(json.dumps(rows))
        (out / "items.json").write_text(json.dumps([ITEM]))
        lines = [f"fig6.3,motion,{p},{c},{x / 50},{c + 2 + np.sin(x / 9)}" for p in range(2) for c in range(5) for x in range(100)]
        (out / "curves.csv").write_text("\n".join(["item,figure,panel,curve,x,y", *lines, "fig6.3,motion,1,4,3,"]) + "\n")
        return out

    return write


def test_only_what_could_have_failed_is_counted(folder):
    html = thesis_report.page(read_results([folder("a", ROWS)])).html()
    for sentence in (
        "3 rows of the comparison could have failed: 2 agree, 1 differs.",
        "2 are values, which could be missed on both sides: 1 agrees, 1 differs.",
        "1 are bounds and claims of an order, which could be missed on one side: 1 agrees.",
        "Not counted: 1 by construction, 1 not comparable.",
        "in 1 row not every seed gives the same verdict",
    ):
        assert sentence in html, sentence
    assert "lack a run" not in html


def test_a_row_has_spread_tolerance_reason_support_and_words(folder):
    html = thesis_report.page(read_results([folder("a", ROWS)])).html()
    for text in ("0.4 ± 0.012 rad/s", "≤ 0.5 rad/s", "differs, 9/10 seeds", "noted because [catchNothing, ", "Bound. Tolerance: at most (convention).", "“does not exceed”"):
        assert text in html, text
    assert "0.4 rad/s" in html  # the deterministic one


def test_a_reason_without_support_is_told(folder):
    rows = [{**ROWS[1], "support": ""}, {**ROWS[3], "reason": "Not explained."}]
    assert "2 reasons lack a run or test that shows them." in thesis_report.page(read_results([folder("a", rows)])).html()


def test_what_was_fitted_and_fails_is_told(folder):
    html = thesis_report.page(read_results([folder("a", [*ROWS, row("g", "differs", kind="by construction", **OWED)])])).html()
    assert "In 1 row more what was fitted or given does not come out." in html and "3 rows of the comparison could have failed" in html


def test_results_side_by_side_show_the_verdicts_that_differ(folder):
    other = [*ROWS[1:], row("a", "differs", ours=0.9, **OWED), row("new", "agrees")]
    html = thesis_report.page(read_results([folder("one", ROWS), folder("two", other)])).html()
    assert "Of 6 common rows 1 have another verdict" in html
    same = thesis_report.page(read_results([folder("three", ROWS), folder("four", ROWS)])).html()
    assert "Of 6 common rows 0 have another verdict" in same


def test_curves_are_found_thinned_and_broken(folder):
    result = read_results([folder("a", ROWS)])[0]
    curves = thesis_report.Curves(result.table("curves.csv"))
    x, y = curves.of("fig6.3", "motion", 1, 4)
    assert len(x) == 101 and np.isnan(y[-1]) and x[50] == 1.0
    assert len(curves.of("fig6.3", "motion", 9, 0)[0]) == 0
    long = thesis_report.Curves({"item": ["a"] * 5000, "figure": ["f"] * 5000, "panel": [0.0] * 5000, "curve": [0.0] * 5000, "x": list(range(5000)), "y": [0.0] * 5000})
    assert len(long.of("a", "f", 0, 0)[0]) <= 2 * thesis_report.CURVE_POINTS


def test_damaged_rows_are_named(folder):
    out = folder("a", [{**ROWS[0], "ours": "much"}])
    with pytest.raises(DataError, match=r"results.json\[0\].ours is"):
        thesis_report.page(read_results([out]))
