# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/numbers.sh: numbers of pages against what commands print, with a program that prints what it is told."""
import importlib.util
import json
import pathlib
import re
import subprocess
import sys

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/numbers/numbers.py"
_spec = importlib.util.spec_from_file_location("page_numbers", SCRIPT)
page_numbers = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(page_numbers)


@pytest.fixture
def compare(tmp_path, monkeypatch):
    """Runs the script on a page and a claim; the program "say" prints its arguments and writes them to OUT."""
    (tmp_path / "say").write_text('#!/bin/sh\necho "$2"; mkdir -p "$1"; printf "%s" "$3" > "$1/summary.json"\nexit "${4:-0}"\n')
    (tmp_path / "say").chmod(0o755)

    def run(page, *claims, options=()):
        (tmp_path / "page.md").write_text(page)
        (tmp_path / "claims.json").write_text(json.dumps([{"page": str(tmp_path / "page.md"), **c} for c in claims]))
        done = subprocess.run(
            [sys.executable, SCRIPT, "--claims", tmp_path / "claims.json", "--bin", tmp_path, *options], capture_output=True, text=True
        )
        return done.returncode, done.stdout

    return run


def claim(text, says, sources, **other):
    return {"text": text, "command": f"say OUT '{says}' '{json.dumps(other.pop('summary', {}))}'", "from": sources, **other}


def test_a_number_that_holds_and_one_that_is_stale(compare, random):
    for _ in range(5):
        value = round(float(random.uniform(0.1, 99)), int(random.integers(0, 4)))
        good = claim("error {x} deg", f"error={value}", {"x": r"re: error=([\d.]+)"})
        status, said = compare(f"The\nerror {value}\ndeg is small.", good)
        assert status == 0 and said.startswith("ok") and "1 numbers compared, 0 stale" in said, said
        status, said = compare(f"The error {value + 1.5} deg is small.", good)
        assert status == 1 and said.startswith("STALE"), said


def test_rounding_is_that_of_the_page_and_times_have_a_ratio(compare):
    c = claim("{x} us", "t=0.349", {"x": r"re: t=([\d.]+)"})
    assert compare("0.3 us", c)[0] == 0 and compare("0.35 us", c)[0] == 0
    assert compare("0.34 us", c)[0] == 1 and compare("0.4 us", c)[0] == 1
    loose = {**c, "factor": {"x": 2.5}}
    assert compare("0.8 us", loose)[0] == 0 and compare("0.15 us", loose)[0] == 0
    assert compare("0.9 us", loose)[0] == 1 and compare("0.13 us", loose)[0] == 1


def test_numbers_of_every_form(compare):
    for page, said, ok in [
        ("2.1e-15", "2.14e-15", True),
        ("2.1e-15", "2.2e-15", False),
        ("102,402", "102402", True),
        ("102,402", "102403", False),
        ("-3e4", "-29999", True),
    ]:
        status, out = compare(f"at {page} m", claim("at {x} m", f"d={said}", {"x": r"re: d=(\S+)"}))
        assert status == (0 if ok else 1), (page, said, out)
    bound = {**claim("below {x} um", "d=3.1e-8", {"x": r"re: d=(\S+)"}), "scale": {"x": 1e6}}
    assert compare("below 0.03 um", bound)[0] == 0 and compare("below 0.05 um", bound)[0] == 1
    assert compare("below 0.05 um", {**bound, "at_most": ["x"]})[0] == 0
    assert compare("below 0.02 um", {**bound, "at_most": ["x"]})[0] == 1


def test_all_that_is_printed(compare):
    c = claim("{x} m, {n} in all, first {f}", "d=3 d=7 d=5", {"x": r"max: d=(\d)", "n": r"sum: d=(\d)", "f": r"re: d=(\d)"})
    assert compare("7 m, 15 in all, first 3", c)[0] == 0
    assert compare("3 m, 15 in all, first 3", c)[0] == 1


def test_benchmarks_by_name(compare):
    runs = [{"name": "a, 2 rows/iterations:5", "cpu_time": 1500.0, "p50": 3}, {"name": "a", "cpu_time": 1}]
    c = {"text": "{t} us, {p}", "command": f"say OUT '{json.dumps({'benchmarks': runs}, indent=1)}' '' 0", "scale": {"t": 1e-3}}
    c["from"] = {"t": "bench: a, 2 rows: cpu_time", "p": "bench: a, 2 rows: p50"}
    assert compare("1.5 us, 3", c)[0] == 0
    assert compare("1.4 us, 3", c)[0] == 1
    ratio = {**c, "text": "{r} times", "from": {"r": "ratio: a, 2 rows: cpu_time / a, 2 rows: p50"}, "scale": {}}
    assert compare("500 times", ratio)[0] == 0 and compare("400 times", ratio)[0] == 1
    missing = {**c, "from": {"t": "bench: b: p50", "p": "bench: a: cpu_time"}}
    status, said = compare("1.5 us, 3", missing)
    assert status == 1 and "0 benchmarks have the name b" in said
    status, said = compare("1.5 us, 3", {**missing, "needs": "PEER_B"})
    assert status == 0 and "needs PEER_B" in said and "0 numbers compared" in said


def test_update_writes_what_is_measured(compare, tmp_path):
    c = claim("{x} and {n} of {m}", "0.349 12345 7", {"x": r"re: ([\d.]+)", "n": r"re: \d (\d{5})", "m": r"re: (\d)$"})
    assert compare("It is 0.31 and 1,234 of 7.", c, options=["--update"])[0] == 1
    assert (tmp_path / "page.md").read_text() == "It is 0.35 and 12,345 of 7."


def test_json_lists_loops_and_long_commands(compare):
    summary = {"runs": [{"law": "a", "plant": "A", "deg": 2}, {"law": "b", "plant": "A", "deg": 3}]}
    c = claim("| $ | {x} |", "", {"x": "summary.json runs law=$,plant=A deg"}, summary=summary, **{"for": ["a", "b"]})
    assert compare("| a | 2 |\n| b | 3 |", c)[0] == 0
    status, said = compare("| a | 2 |\n| b | 4 |", c)
    assert status == 1 and "2 numbers compared, 1 stale" in said
    status, said = compare("| a | 7 |\n| b | 7 |", {**c, "long": 20})
    assert status == 0 and "0 numbers compared" in said
    assert compare("| a | 7 |\n| b | 3 |", {**c, "long": 20}, options=["--long"])[0] == 0
    assert compare("| a | 7 |\n| b | 3 |", {**c, "long": 20}, options=["--long", "20"])[0] == 1


def test_what_cannot_be_compared_is_stale(compare):
    good = claim("{x} us", "t=1", {"x": r"re: t=([\d.]+)"})
    for page, changed, sentence in [
        ("nothing", {}, 'the page does not say "{x} us"'),
        ("1 us", {"from": {"x": r"re: u=([\d.]+)"}}, "the command does not print"),
        ("1 us", {"from": {"x": "summary.json no"}}, "the result has no field no"),
        (
            "1 us",
            {"from": {"x": "summary.json runs law=a deg"}, "command": """say OUT '' '{"runs": [{"law": "a", "deg": 1}, {"law": "a", "deg": 1}]}'"""},
            "2 entries have law=a",
        ),
        ("1 us", {"command": "hush OUT"}, "hush is not built"),
        ("1 us", {"command": "say OUT t=1 {} 3"}, "ended with status 3"),
    ]:
        status, said = compare(page, {**good, **changed})
        assert status == 1 and sentence in said, said


def test_every_claim_of_the_pages_is_in_its_page():
    done = subprocess.run([sys.executable, SCRIPT, "--list"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_every_number_of_the_readme_has_a_claim():
    readme = (SCRIPT.parents[2] / "README.md").read_text()
    section = readme[readme.index("## What it measures") :].split("\n## ")[0]
    rows = [line for line in section.splitlines() if line.startswith("* ")]
    texts = [c["text"] for c in json.loads((SCRIPT.parent / "claims.json").read_text()) if c["page"] == "README.md"]
    assert len(rows) >= 6
    for row in rows:
        assert any(re.search(page_numbers.pattern_of(text)[1], row) for text in texts), row
