# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""The programs' data against the schema, and the pages made of it, opened by a browser. VISP_DIRECT_PROGRAM: of one program only."""
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from browser import CHROMIUM, Browser
from conftest import DATA, longer, value_of
from visp_direct.report.data import DataError, Result, check, read_results

BIN = pathlib.Path(os.environ.get("VISP_DIRECT_BIN", "."))
ONLY = os.environ.get("VISP_DIRECT_PROGRAM", "")
OUT = pathlib.Path(os.environ.get("VISP_DIRECT_TEST_OUT", ".")) / (ONLY or "all")
OUT.mkdir(parents=True, exist_ok=True)
PROBE = (pathlib.Path(__file__).parent / "probe.js").read_text()


def of(program):
    return pytest.mark.skipif(ONLY not in ("", program), reason=f"is a test of {program}")


def damaged(value, schema, random):
    """The value with one field renamed, somewhere where the schema knows the fields; None where it knows none."""
    if isinstance(schema, dict):
        key = list(value)[random.integers(len(value))]
        inner = damaged(value[key], schema.get(key, schema.get(key + "?")), random) if random.random() < 0.7 else None
        if inner is not None:
            return {**value, key: inner}
        return {**{k: v for k, v in value.items() if k != key}, key + "x": value[key]}
    if isinstance(schema, list) and value:
        i = random.integers(len(value))
        inner = damaged(value[i], schema[0], random)
        return None if inner is None else [*value[:i], inner, *value[i + 1 :]]
    return None


def name_of(call):
    return f"{call[0]}-{pathlib.Path(call[1].split('=')[-1]).name}"


@functools.cache
def run(program, *arguments, **environment):
    """Runs a program in OUT, once; its result folder, and what it said."""
    if not (BIN / program).is_file():
        pytest.skip(f"{program} is not built")
    folder = OUT / f"{name_of((program, *arguments))}-{len(arguments)}-{len(environment)}"
    shutil.rmtree(folder, ignore_errors=True)
    done = subprocess.run([BIN / program, *arguments, "--out", folder], capture_output=True, text=True, env={**os.environ, **environment})
    assert done.returncode == 0, done.stderr
    return folder, done.stderr


SMALL = OUT / "small.json"
SMALL.write_text(
    json.dumps(
        {
            "seed": 4,
            "design": {
                "frame_rate_hz": [300, 1600, 2400],
                "image_px": [[96, 72], [160, 100]],
                "um_per_px": [2, 6],
                "drop_velocity_mm_s": 40,
                "controller": ["observer", "pid"],
            },
            "task": {"cells": 8, "runs": 1},
            "require": {"landing_worst_um": 10},
        }
    )
)
FEW = OUT / "few.jsonl"  # a figure takes a second
FEW.write_text("".join((DATA / "trajectory/examples.jsonl").read_text().splitlines(keepends=True)[::4]))
SHORT = OUT / "short.json"  # a task of visp-servo-compare, with names that are no text of HTML or of a formula
SHORT.write_text(
    json.dumps(
        {
            "name": "a <b> & $\\frac{$",
            "camera": {"px": 800, "py": 800, "u0": 320, "v0": 240},
            "object": {"width_m": 0.18, "height_m": 0.18},
            "start": {"position_m": [0, 0, 0.5], "rotation_deg": [0, 0, 0]},
            "segments": [
                {"name": "<i> $\\frac{$", "position_m": [0.02, 0, 0.4], "rotation_deg": [0, -20, 0], "duration_s": 1},
                {"position_m": [0, 0, 0.5], "rotation_deg": [0, 0, 0], "duration_s": 1},
            ],
            "plants": [{"name": "slow one", "like": "D"}],
        }
    )
)
PROGRAMS = [
    ("visp-plan-trajectory", str(FEW)),
    ("visp-plan-trajectory", str(DATA / "trajectory/figure-6.3.jsonl")),
    ("visp-arm", "amor", "--fk", "0.1,0.2,0.3,-0.4,0.5,0.6,0.7"),
    (
        "visp-arm",
        str(DATA / "robot/generic-6r.urdf"),
        "--robot-tip",
        "tool",
        "--acceleration-limits",
        "5,5,5,5,5,5",
        "--fk",
        "0.3,-0.2,0.1,0.4,0.5,0.6",
    ),
    ("visp-print-pattern", "--cells=6", "--sensor=tracker", "--identify"),
    ("visp-print-pattern", f"--explore={SMALL}"),
    ("visp-avoid-obstacle", "--sensor=poses", "--duration=0.6"),
    ("visp-avoid-obstacle", "--replica=fig8.6"),
    ("visp-avoid-obstacle", "--replica=fig8.9"),
    ("visp-avoid-obstacle", "--replica=fig8.12"),
    ("visp-plan-compare", "--scene=S3,S5", "--method=potential,dtg,dtg-via", "--seeds=2"),
    ("visp-track-pattern", "--frames=90"),
    ("visp-servo", "--lambda=3", "--object-pose=0.01,-0.005,0.31,1,-3,5", "--start-time=0.2"),
    ("visp-servo-compare", f"--task={SHORT}", "--law=pbvs1,ff-lookat-pi+cbf", "--measure=points", "--monte-carlo=2"),
    ("visp-servo-compare", "--robot=amor", f"--task={SHORT}", "--law=pbvs1,dtg", "--measure=points", "--shape"),
    ("visp-thesis-report", "--only=fig6.3"),
]
PROGRAMS = [call for call in PROGRAMS if ONLY in ("", call[0])]


@pytest.mark.parametrize("call", PROGRAMS, ids=name_of)
def test_data_is_as_the_schema_says(call, random):
    folder, _ = run(*call)
    result = Result(folder)
    for name in result.files():
        if name.endswith(".csv"):
            assert len({len(column) for column in result.table(name).values()}) == 1
        else:
            value = result.json(name)
            for _ in range(longer(50)):
                bad = damaged(value, result.described(name), random)
                if bad is not None:
                    with pytest.raises(DataError, match=re.escape(name)):
                        check(bad, result.described(name), name)


def known_place(folder, call):
    """A configuration, and where the tool is there by the program; [] without an arm."""
    if "--fk" in call:
        pose = json.loads((folder / "robot.json").read_text())["pose"]
        return [float(x) for x in call[-1].split(",")], [row[3] for row in pose[:3]]
    logs = [name for name in Result(folder).files() if name.startswith(("samples", "log/"))]
    if not logs:
        return [], []
    table = Result(folder).table(logs[0])
    if "tool_x_m" not in table:
        return [], []
    joints = json.loads((folder / "arm.json").read_text())["joints"]
    return [table[f"q_{joint['name']}"][-1] for joint in joints], [table[f"tool_{axis}_m"][-1] for axis in "xyz"]


def carried_camera(folder):
    """The last configuration of a log of servoing, the camera in the base then, and its distance from the tool; [] without an arm."""
    result = Result(folder)
    if not result.program.startswith("visp-servo") or not (folder / "arm.json").is_file():
        return [], None, None
    log = result.table(next(name for name in result.files() if name == "log.csv" or name.startswith("log/")))
    base = np.array(result.summary["robot"]["camera_at_start"]) if "robot" in result.summary and "tx_m" in log else np.eye(4)
    place = [log[f"t{axis}_m" if "tx_m" in log else f"fMc_t{axis}"][-1] for axis in "xyz"]
    arm = result.json("arm.json")
    assert arm["camera_link"] in (-1, arm["tool_link"])
    distance = np.linalg.norm(np.subtract(arm["camera"], arm["tool"])[:3, 3])
    row = -2 if "tx_m" in log else -1  # joints are those at the end of a row's cycle, or of its time
    return [log[f"q_{joint['name']}"][row] for joint in arm["joints"]], (base @ [*place, 1])[:3], distance


@pytest.fixture(scope="module")
def browser():
    if CHROMIUM is None:
        pytest.skip("chromium is missing")
    opened = Browser()
    yield opened
    opened.close()


@pytest.mark.parametrize("call", PROGRAMS, ids=name_of)
def test_report_opens_without_an_error(call, browser):
    """No message in the console; the 3D canvas has a picture that a slider changes; nothing is wider than the window, also of a phone."""
    folder, said = run(*call)
    assert "without a report" not in said
    page = (folder / "report.html").read_text()
    text = re.sub(r"<script.*?</script>|<svg.*?</svg>|src=\"data:[^\"]*\"", "", page, flags=re.S)
    assert len(page) < 6e6 and "e+0" not in text
    assert "http" not in re.sub(r"http://www.w3.org/\S+|<script>.*?</script>", "", page, flags=re.S)
    q, tool = known_place(folder, call)
    carrying, camera, distance = carried_camera(folder)
    browser.open(folder / "report.html")
    browser.screenshot(folder / "report-1200.png")
    verdict = browser.evaluate(f"({PROBE})({json.dumps(q or carrying)})")
    browser.resize(390)
    browser.screenshot(folder / "report-390.png")
    assert verdict["wide"] <= 0 and browser.evaluate("document.documentElement.scrollWidth - window.innerWidth") <= 0
    assert not browser.messages
    assert len(verdict["sorted"]) > 0 and sorted(verdict["sorted"]) == sorted(verdict["unsorted"])
    views = verdict["views"]
    if call[0].startswith("visp-servo") or q:
        assert views and all(view["colours"] > 20 for view in views), verdict
    if call[0].startswith("visp-servo"):
        assert all(view["moved"] > 20 for view in views), verdict
    if call[0] in ("visp-servo-compare", "visp-plan-compare"):
        changed, same = views[0]["chosen"]
        assert changed > 20 and same == 0
    if call[0] == "visp-servo-compare":
        result = Result(folder)
        for law, sight in zip(result.summary["laws"], views[0]["sight"]):  # one on each side
            log = result.table(next(run["log"] for run in result.summary["runs"] if run["law"] == law["id"] and "log" in run))
            row = int(np.argmin(np.abs(np.array(log["time_s"]) - 0.8 * log["time_s"][-1])))  # where the slider is
            pixel = np.array(sight) * [640, 480] - 0.5
            np.testing.assert_allclose(pixel, [log["u_px"][row], log["v_px"][row]], atol=0.1)  # seen as by the simulated camera
    if carrying:  # the arm of the page carries the camera as that of the program did
        assert np.linalg.norm(np.subtract(views[0]["tool"], camera)) == pytest.approx(distance, abs=1e-5)
        assert np.linalg.norm(np.subtract(*views[0]["carried"])) == pytest.approx(distance, abs=5e-4)
    elif q:  # the page moves the arm as the library does
        assert all(view["moved"] in (None, *range(20, 5000)) for view in views), verdict
        np.testing.assert_allclose(views[0]["tool"], tool, atol=1e-9 if call[0] == "visp-arm" else 1e-5)
    if call[0] == "visp-plan-trajectory":
        values = [value_of(text) for text in verdict["sorted"]]
        assert values == sorted(values) and verdict["figures"] >= 1


@of("visp-plan-trajectory")
def test_without_python_the_data_stays():
    folder, said = run("visp-plan-trajectory", str(DATA / "trajectory/figure-6.3.jsonl"), VISP_DIRECT_PYTHON="/nowhere/python3")
    assert re.search(
        r"The data is in .*, without a report, which needs Python: /nowhere/python3 was not found; make it later by: "
        r"python3 -m visp_direct.report ",
        said,
    ), said
    assert (folder / "motions.json").is_file() and not (folder / "report.html").exists()
    made = subprocess.run([sys.executable, "-m", "visp_direct.report", folder, "--paper"], capture_output=True, text=True)
    assert made.returncode == 0 and (folder / "report.html").is_file(), made.stderr
    assert [file.read_bytes()[:5] for file in (folder / "paper").iterdir()] == [b"%PDF-"]


@of("visp-plan-trajectory")
def test_results_side_by_side(tmp_path):
    first, _ = run("visp-plan-trajectory", str(FEW))
    second, _ = run("visp-plan-trajectory", str(DATA / "trajectory/figure-6.3.jsonl"))
    made = subprocess.run([sys.executable, "-m", "visp_direct.report", first, second], capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    page = (first / "report.html").read_text()
    assert first.name in page and second.name in page
    made = subprocess.run([sys.executable, "-m", "visp_direct.report", first, "--views"], capture_output=True, text=True)
    assert made.returncode == 1 and made.stderr.endswith("its report has no 3D view\n") and not list(first.glob("view-*"))
    (tmp_path / "summary.json").write_text('{"program": "visp-arm", "command": "", "robot": "", "problems": []}')
    with pytest.raises(DataError, match="is a result of visp-arm"):
        read_results([first, tmp_path])
    (tmp_path / "summary.json").write_text("{")
    made = subprocess.run([sys.executable, "-m", "visp_direct.report", tmp_path], capture_output=True, text=True)
    assert made.returncode == 1 and "summary.json: is not valid JSON" in made.stderr and made.stderr.count("\n") == 1


@of("visp-avoid-obstacle")
def test_two_runs_stand_beside_each_other(browser):
    """One sees the obstacle, the other, whose camera is covered, knows none."""
    folders = [run("visp-avoid-obstacle", "--sensor=poses", *more, "--duration=0.6")[0] for more in ((), ("--hide=0:9",))]
    made = subprocess.run([sys.executable, "-m", "visp_direct.report", *folders, "--paper", "--views"], capture_output=True, text=True)
    assert made.returncode == 0 and "Warning" not in made.stderr, made.stderr
    page = (folders[0] / "report.html").read_text()
    view = (folders[0] / "view-1.html").read_text()
    assert view.count("vispView(document") == 1 and "<table" not in view and not (folders[0] / "view-2.html").exists()
    browser.open(folders[0] / "view-1.html")
    assert not browser.messages and browser.evaluate("document.querySelector('.view').vispView && window.innerHeight") > 0
    scene = json.loads(re.search(r"vispView\(document.getElementById\(\"view0\"\), (.*)\);</script>", page).group(1))
    assert [name["name"] for name in scene["runs"]] == [folder.name for folder in folders]
    assert len(scene["arms"]) == 2 and np.linalg.norm([row[3] for row in scene["runs"][1]["base"][:3]]) > 0.8
    assert "nothing was ever seen" in page and len(list((folders[0] / "paper").iterdir())) == 8
