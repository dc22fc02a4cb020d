# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Reports: numbers, meshes, plots, text and tables of a page."""
import re
import struct

import numpy as np
import pytest
from conftest import DATA, longer, value_of
from visp_direct.report.page import Cell, Page, columns_of, number
from visp_direct.report.plots import COLUMN, STYLE, WIDTH, Figure, legend_above, logarithmic_if_flat
from visp_direct.report.view3d import clustered, read_stl


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


def test_columns_are_described_in_text():
    record = {"name": "a", "size": {"x_m": 0.25, "n": 3}, "none": None, "of": {"from": "here"}}
    described = ["name; mm = 1000 size.x_m; number = 10 size.n; of = of.from", ("", "name"), ("own", lambda r: r["size"]["n"] + 1)]
    columns = list(columns_of([*described, "lost = none.x; gone = 1e3 missing; 50 % = size.n"]))
    assert [header for header, _ in columns] == ["name", "mm", "number", "of", "", "own", "lost", "gone", "50 %"]
    assert [get(record) for _, get in columns] == ["a", 250.0, 30, "here", "a", 4, None, None, 3]
    assert isinstance(columns[2][1](record), int)
    page = Page("", "")
    page.section("")
    page.records([record, record], ["name; size.n"], best=lambda each: False)
    page.records([{"x": 1}, {"x": 2}], [("x", lambda each: Cell(each["x"], "worst"))], best=lambda each: each["x"] == 2)
    rows = [part["rows"] for part in page.sections[0]["parts"]]
    assert [[cell.text for cell in row] for row in rows[0]] == [["a", "3"]] * 2
    assert [row[0].style for row in rows[1]] == ["worst", "worst best"]


def test_results_are_named_only_among_several():
    one, two = (type("Made", (), {"name": name, "summary": {"findings": [f"found by {name}"]}}) for name in "ab")
    alone, both = Page("", "", [one]), Page("", "", [one, two])
    assert alone.answer == ["found by a"] and both.answer == ["a: found by a", "b: found by b"]
    for page in (alone, both):
        page.section("Motion", one)
        page.section("What was seen", "What a saw")
    assert [section["title"] for section in alone.sections] == ["Motion", "What was seen"]
    assert [section["title"] for section in both.sections] == ["Motion of a", "What a saw"]
    assert (alone.name(one, "it"), both.name(one, "it")) == ("it", "a")


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
    meshes = vd.show(arm, scene, file=tmp_path / "bare.html").read_text().count('"kind": "mesh"')
    scene.add(vd.CollisionObject(name="map", shape=vd.CollisionShape.octree(vd.Octree([[1, 0, 1, 0.1]]))))
    file = vd.show(arm, scene, np.array([task.start, task.goal]), tmp_path / "arm.html")
    page = file.read_text()
    assert "vispView" in page and page.count('"kind": "mesh"') == meshes + 1 and '"kind": "cylinder"' in page and "capsule" in page
    assert vd.show(arm, file=tmp_path / "home.html").is_file()
    with pytest.raises(ValueError, match=r"a path of shape \(2, 3\) was given, must be n x 7"):
        vd.show(arm, scene, np.zeros((2, 3)), tmp_path / "bad.html")
