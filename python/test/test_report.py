# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Reports: numbers, schema, meshes, plots, and the pages of the programs, opened by a browser."""
import functools
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys

import numpy as np
import pytest
from conftest import DATA, longer
from visp_direct.report.data import DataError, Result, check, read_results
from visp_direct.report.page import Page, number
from visp_direct.report.plots import COLUMN, STYLE, WIDTH, Figure, legend_above, logarithmic_if_flat
from visp_direct.report.view3d import clustered, read_stl

BIN = pathlib.Path(os.environ.get("VISP_DIRECT_BIN", "."))
OUT = pathlib.Path(os.environ.get("VISP_DIRECT_TEST_OUT", "."))
CHROMIUM = shutil.which("chromium")


def value_of(text):
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
    mantissa, _, power = text.partition("·10")
    return float(mantissa.translate(digits)) * 10.0 ** int(power.translate(digits) or 0)


def test_numbers_have_three_digits_and_no_e(random):
    for _ in range(longer(2000)):
        x = random.choice([-1, 1]) * 10.0 ** random.uniform(-12, 12)
        text = number(float(x))
        assert "e" not in text and len(text) <= 12 and value_of(text) == pytest.approx(x, rel=5.1e-3), text
        assert len(re.sub(r"·10.*|[−.]", "", text).strip("0")) <= 3, text
    assert [number(x) for x in (0, 24300.0, 0.00123, 999.9, float("nan"), float("-inf"), None)] == [
        "0",
        "24300",
        "0.00123",
        "1000",
        "–",
        "−∞",
        "–",
    ]


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
    done = subprocess.run(
        [BIN / program, *arguments, "--out", folder], capture_output=True, text=True, env={**os.environ, **environment}
    )
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
    ("visp-plan-trajectory", str(DATA / "trajectory/examples.jsonl")),
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


# On a phone once for each program.
PAGES = [(call, 1200) for call in PROGRAMS] + [
    (call, 390) for call in {call[0]: call for call in PROGRAMS[::-1]}.values()
]


@pytest.mark.parametrize("call, width", PAGES, ids=[f"{name_of(call)}-{width}" for call, width in PAGES])
def test_report_opens_without_an_error(call, width):
    """No message in the console; the 3D canvas has a picture that a slider changes; nothing is wider than the window."""
    if CHROMIUM is None:
        pytest.skip("chromium is missing")
    folder, said = run(*call)
    assert "without a report" not in said
    page = (folder / "report.html").read_text()
    assert len(page) < 6e6 and "e+0" not in re.sub(
        r"<script.*?</script>|<svg.*?</svg>|src=\"data:[^\"]*\"", "", page, flags=re.S
    )
    assert "http" not in re.sub(r"http://www.w3.org/\S+|<script>.*?</script>", "", page, flags=re.S)
    probe = """<pre id="verdict"></pre><script>
window.addEventListener("load", () => setTimeout(() => {
  const seen = (canvas) => {
    const small = Object.assign(document.createElement("canvas"), {width: 80, height: 60}), c = small.getContext("2d");
    c.drawImage(canvas, 0, 0, 80, 60);
    return [...c.getImageData(0, 0, 80, 60).data];
  };
  const differ = (a, b) => a.filter((v, i) => Math.abs(v - b[i]) > 8).length;
  const views = [...document.querySelectorAll(".view")].map((view) => {
    const canvas = view.querySelector("canvas"), before = seen(canvas), slider = view.querySelector("input[type=range]");
    let moved = null, chosen = null, sight = [];
    if (slider) {
      slider.value = Number(slider.min) + 0.8 * (slider.max - slider.min);
      slider.dispatchEvent(new Event("input"));
      moved = differ(before, seen(canvas));
      sight = view.vispView ? view.vispView.scene.runs.slice(0, 2).map((_, i) => view.vispView.see(i)) : [];
    }
    const menu = view.querySelector("select");
    if (menu) { // another run on the left, and back
      const was = menu.value, first = seen(canvas);
      const choose = (value) => { menu.value = value; menu.dispatchEvent(new Event("change")); return differ(first, seen(canvas)); };
      chosen = [choose([...menu.options].map((o) => o.value).find((v) => v !== was)), choose(was)];
    }
    const q = FK;
    const run = view.vispView && view.vispView.scene.runs[0], k = run ? Math.floor(0.1 * run.t.length) : 0;
    const carried = run && run.camera && q.length ? [view.vispView.toolAt(0, run.q[k]), [3, 7, 11].map((i) => run.camera.pose[k][i])] : [];
    return {carried, tool: q.length && view.vispView ? view.vispView.toolAt(0, q) : [], colours: new Set(before.map((v, i) => i % 4 ? 0 : before.slice(i, i + 3).join())).size,
            moved, chosen, sight};
  });
  const table = document.querySelector("table.sorts"), rows = () => [...table.tBodies[0].rows].map((r) => r.cells[1].textContent);
  const unsorted = rows();
  table.querySelectorAll("th")[1].click();
  document.getElementById("verdict").textContent = JSON.stringify({views, sorted: rows(), unsorted,
    wide: document.documentElement.scrollWidth - window.innerWidth, figures: document.querySelectorAll("figure.plot svg").length});
}, 500));</script></body>"""
    probed = folder / "probe.html"
    q, tool = known_place(folder, call)
    carrying, camera, distance = carried_camera(folder)
    q = q or carrying
    probed.write_text(page.replace("</body>", probe.replace("FK", json.dumps(q))))
    browser = [
        CHROMIUM,
        "--headless",
        "--no-sandbox",
        "--use-gl=angle",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--enable-logging=stderr",
        "--hide-scrollbars",
        f"--window-size={width},1600",
        "--virtual-time-budget=20000",
    ]
    dumped = subprocess.run([*browser, "--dump-dom", probed.as_uri()], capture_output=True, text=True, timeout=300)
    assert "CONSOLE" not in dumped.stderr, re.findall(r".*CONSOLE.*", dumped.stderr)
    verdict = json.loads(
        re.search(r'<pre id="verdict">(.*?)</pre>', dumped.stdout, re.S)
        .group(1)
        .replace("&gt;", ">")
        .replace("&lt;", "<")
    )
    assert (
        verdict["wide"] <= 0
        and len(verdict["sorted"]) == len(verdict["unsorted"])
        and sorted(verdict["sorted"]) == sorted(verdict["unsorted"])
    )
    if call[0].startswith("visp-servo"):
        assert verdict["views"] and all(view["colours"] > 20 and view["moved"] > 20 for view in verdict["views"]), verdict
    if call[0] == "visp-servo-compare":
        changed, same = verdict["views"][0]["chosen"]
        assert changed > 20 and same == 0
        result = Result(folder)
        for law, sight in zip(result.summary["laws"], verdict["views"][0]["sight"]):  # one on each side
            log = result.table(next(run["log"] for run in result.summary["runs"] if run["law"] == law["id"] and "log" in run))
            row = int(np.argmin(np.abs(np.array(log["time_s"]) - 0.8 * log["time_s"][-1])))  # where the slider is
            pixel = np.array(sight) * [640, 480] - 0.5
            np.testing.assert_allclose(pixel, [log["u_px"][row], log["v_px"][row]], atol=0.1)  # seen as by the simulated camera
    if carrying:  # the arm of the page carries the camera as that of the program did
        assert np.linalg.norm(np.subtract(verdict["views"][0]["tool"], camera)) == pytest.approx(distance, abs=1e-5)
        assert np.linalg.norm(np.subtract(*verdict["views"][0]["carried"])) == pytest.approx(distance, abs=5e-4)
    elif q:  # the page moves the arm as the library does
        assert verdict["views"] and all(view["colours"] > 20 and view["moved"] in (None, *range(20, 5000)) for view in verdict["views"]), verdict
        np.testing.assert_allclose(verdict["views"][0]["tool"], tool, atol=1e-9 if call[0] == "visp-arm" else 1e-5)
    if call[0] == "visp-plan-compare":
        changed, same = verdict["views"][0]["chosen"]
        assert changed > 20 and same == 0
    if call[0] == "visp-plan-trajectory":
        values = [value_of(text) for text in verdict["sorted"]]
        assert values == sorted(values) and verdict["figures"] >= 1
    subprocess.run(
        [*browser, f"--screenshot={folder / f'report-{width}.png'}", (folder / "report.html").as_uri()],
        capture_output=True,
        timeout=300,
    )
    assert (folder / f"report-{width}.png").stat().st_size > 10000
    probed.unlink()


def test_without_python_the_data_stays():
    folder, said = run(
        "visp-plan-trajectory", str(DATA / "trajectory/figure-6.3.jsonl"), VISP_DIRECT_PYTHON="/nowhere/python3"
    )
    assert re.search(
        r"The data is in .*, without a report, which needs Python: /nowhere/python3 was not found; make it later by: "
        r"python3 -m visp_direct.report ",
        said,
    ), said
    assert (folder / "motions.json").is_file() and not (folder / "report.html").exists()
    made = subprocess.run(
        [sys.executable, "-m", "visp_direct.report", folder, "--paper"], capture_output=True, text=True
    )
    assert made.returncode == 0 and (folder / "report.html").is_file(), made.stderr
    assert [file.read_bytes()[:5] for file in (folder / "paper").iterdir()] == [b"%PDF-"]


def test_results_side_by_side(tmp_path):
    first, _ = run("visp-plan-trajectory", str(DATA / "trajectory/examples.jsonl"))
    second, _ = run("visp-plan-trajectory", str(DATA / "trajectory/figure-6.3.jsonl"))
    made = subprocess.run([sys.executable, "-m", "visp_direct.report", first, second], capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    page = (first / "report.html").read_text()
    assert first.name in page and second.name in page
    (tmp_path / "summary.json").write_text('{"program": "visp-arm", "command": "", "robot": "", "problems": []}')
    with pytest.raises(DataError, match="is a result of visp-arm"):
        read_results([first, tmp_path])
    (tmp_path / "summary.json").write_text("{")
    made = subprocess.run([sys.executable, "-m", "visp_direct.report", tmp_path], capture_output=True, text=True)
    assert made.returncode == 1 and "summary.json: is not valid JSON" in made.stderr and made.stderr.count("\n") == 1


def test_two_runs_stand_beside_each_other():
    """One sees the obstacle, the other, whose camera is covered, knows none."""
    folders = [
        run("visp-avoid-obstacle", "--sensor=poses", *more, "--duration=0.6")[0] for more in ((), ("--hide=0:9",))
    ]
    made = subprocess.run(
        [sys.executable, "-m", "visp_direct.report", *folders, "--paper"], capture_output=True, text=True
    )
    assert made.returncode == 0 and "Warning" not in made.stderr, made.stderr
    page = (folders[0] / "report.html").read_text()
    scene = json.loads(re.search(r"vispView\(document.getElementById\(\"view0\"\), (.*)\);</script>", page).group(1))
    assert [name["name"] for name in scene["runs"]] == [folder.name for folder in folders]
    assert len(scene["arms"]) == 2 and np.linalg.norm([row[3] for row in scene["runs"][1]["base"][:3]]) > 0.8
    assert "nothing was ever seen" in page and len(list((folders[0] / "paper").iterdir())) == 8


def test_meshes_keep_their_shape(random):
    """A torus of 19200 triangles, with few of them: still a closed surface of the same extent, near its own."""
    rows, columns = 120, 80
    for _ in range(longer(5)):
        radius, tube = random.uniform(0.5, 2), random.uniform(0.1, 0.4)
        u, v = np.meshgrid(np.arange(rows) * 2 * np.pi / rows, np.arange(columns) * 2 * np.pi / columns, indexing="ij")
        ring = radius + tube * np.cos(v)
        vertices = np.stack([ring * np.cos(u), ring * np.sin(u), tube * np.sin(v)], axis=-1).reshape(-1, 3)
        corner = np.arange(rows * columns).reshape(rows, columns)
        a, b, c, d = (np.roll(corner, shift, (0, 1)).ravel() for shift in ((0, 0), (-1, 0), (-1, -1), (0, -1)))
        triangles = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
        fewer_vertices, fewer = clustered(vertices, triangles, 2000)
        assert 500 < len(fewer) <= 2000 and fewer.max() < len(fewer_vertices)
        off = np.hypot(np.hypot(*fewer_vertices[:, :2].T) - radius, fewer_vertices[:, 2]) - tube
        assert np.abs(off).max() < 0.35 * tube
        assert np.abs(np.ptp(fewer_vertices, axis=0) - np.ptp(vertices, axis=0)).max() < 0.35 * tube
        same, kept = clustered(vertices, triangles[:1000], 2000)
        assert len(kept) == 1000 and len(same) == len(vertices)
    corners = random.uniform(-1, 1, (3, 3)).astype("<f4")
    data = b" " * 80 + struct.pack("<I", 2) + 2 * (struct.pack("<3f", 0, 0, 0) + corners.tobytes() + b"\0\0")
    vertices, triangles = read_stl(data)
    assert len(vertices) == 3 and (np.sort(triangles) == [0, 1, 2]).all()
    np.testing.assert_array_equal(vertices[triangles[0]], corners)
    for bad in (b"", data[:-1], b"solid x" + data):
        with pytest.raises(ValueError, match="no binary STL"):
            read_stl(bad)


def test_legend_is_clear_of_the_curves():
    import matplotlib
    from matplotlib import pyplot

    with matplotlib.rc_context(STYLE):
        for width in (WIDTH, COLUMN):
            figure, axes = pyplot.subplots(figsize=(width, 2))
            for i in range(6):
                axes.plot([0, 1], [i, 5 - i], label=f"curve {i}")
            legend_above(axes)
            figure.canvas.draw()
            assert axes.get_legend().get_window_extent().y0 >= axes.get_window_extent().y1
            pyplot.close(figure)
        axes = pyplot.subplots()[1]
        logarithmic_if_flat(axes, [1, 2, 1000, 1])
        assert axes.get_yscale() == "symlog"
        axes = pyplot.subplots()[1]
        logarithmic_if_flat(axes, [1, 2, 10, 1])
        assert axes.get_yscale() == "linear"
        pyplot.close("all")


def test_text_of_a_page_is_escaped():
    page = Page("<script>alert(1)</script>", "a & b")
    page.answers("</p><script>")
    page.section("<b>")
    page.paragraph("<i>x</i>")
    page.table(["<h>"], [["<cell>"], ["<wrap>" * 10]])
    page.facts([("<n>", "<v>")])
    page.figure(Figure(lambda axes: axes[0].plot([0, 1], [0, 1], label="<l>")).named("f", '"><script>'), "<c>")
    html = page.html()
    assert (
        "<script>alert" not in html
        and "</p><script>" not in html
        and "<i>x" not in html
        and "<cell>" not in html
        and "<wrap>" not in html
        and "<v>" not in html
        and '"><script>' not in html
    )
    assert page.html().count("<svg") == 1


def test_show_makes_a_page(tmp_path):
    vd = pytest.importorskip("visp_direct")
    if not hasattr(vd, "show"):
        pytest.skip("the compiled part is missing")
    arm = vd.loadArmJson(str(DATA / "robot/amor.json"))
    loaded = vd.loadCollisionScene(str(DATA / "scene/s4a-pillar.json"))
    scene, task = vd.CollisionScene(arm, loaded.spec), loaded.tasks[0]
    file = vd.show(arm, scene, np.array([task.start, task.goal]), tmp_path / "arm.html")
    page = file.read_text()
    assert "vispView" in page and '"kind": "cylinder"' in page and "capsule" in page
    assert vd.show(arm, file=tmp_path / "home.html").is_file()
    with pytest.raises(ValueError, match=r"a path of shape \(2, 3\) was given, must be n x 7"):
        vd.show(arm, scene, np.zeros((2, 3)), tmp_path / "bad.html")
