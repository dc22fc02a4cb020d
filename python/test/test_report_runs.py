# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Reports of runs: outlines, curves, obstacles of the 3D view, the map of deviations, and the schema of files of which there are several."""
import json
import pathlib

import numpy as np
import pytest
from conftest import longer, rotation
from visp_direct.report import data, runs, view3d
from visp_direct.report.track_pattern import deviation_map, motion_figure, round_below


def area(polygon):
    x, y = polygon.T
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


def test_an_outline_holds_all_of_a_shape_and_no_more(random, tmp_path):
    """Against the shadow of a convex body in closed form."""
    radius, length, size = 0.1, 0.3, np.array([0.1, 0.2, 0.3])
    for _ in range(longer(10)):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = rotation(random.uniform(-2, 2, 3)), random.uniform(-1, 1, 3)
        for axes, look in (((0, 1), [0, 0, 1]), ((1, 2), [1, 0, 0])):
            d = np.abs(pose[:3, :3].T @ look)
            sine = np.hypot(d[0], d[1])
            shadows = {
                "sphere": np.pi * radius**2,
                "capsule": np.pi * radius**2 + 2 * radius * length * sine,
                "box": d @ [size[1] * size[2], size[0] * size[2], size[0] * size[1]],
                "cylinder": np.pi * radius**2 * d[2] + 2 * radius * length * sine,
            }
            for kind, shadow in shadows.items():
                item = {"kind": kind, "pose": pose.tolist(), "radius": radius, "size": size.tolist()}
                item |= {"length": length} if kind != "sphere" else {}
                (polygon,) = runs.outlines(item, axes, tmp_path)
                assert area(polygon) == pytest.approx(shadow, rel=0.01), kind  # circles have 40 corners
            cells = [[0.3, 0, 0, 0.1], [0, 0.4, 0, 0.2]]
            squares = runs.outlines({"kind": "octree", "pose": pose.tolist(), "cells": cells}, axes, tmp_path)
            assert [area(s) for s in squares] == pytest.approx([0.01 * d.sum(), 0.04 * d.sum()])


def test_a_thinned_curve_keeps_its_peaks(random):
    for _ in range(longer(50)):
        n = int(random.integers(1, 5000))
        y = random.normal(size=n)
        t, high = runs.thinned(np.arange(n), y)
        low = runs.thinned(np.arange(n), y, np.min)[1]
        assert len(t) == len(high) <= runs.PLOT_POINTS and high.max() == y.max() and low.min() == y.min()


def test_cubes_are_closed_and_of_their_size(random):
    for _ in range(longer(20)):
        cells = np.column_stack([random.uniform(-1, 1, (4, 3)), random.uniform(0.01, 0.3, 4)])
        vertices, triangles = view3d.cubes(cells)
        corners = vertices[triangles]
        volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
        assert abs(volume) == pytest.approx((cells[:, 3] ** 3).sum())  # all triangles are turned alike


def test_obstacles_stand_beside_each_other():
    track = {"t": [0, 1], "p": [[0, 0, 0], [1, 0, 0]]}
    item = {
        "name": "o",
        "kind": "capsule",
        "radius": 0.1,
        "length": 0.4,
        "pose": np.eye(4).tolist(),
        "known": False,
        "there_s": [0.5, None],
        "track": track,
    }
    wall = {"name": "w", "kind": "mesh", "file": "no.stl", "pose": np.eye(4).tolist(), "known": True}
    parts, missing = view3d.objects_of({"objects": [item, wall]}, pathlib.Path("/nowhere"), [1, 2, 3])
    assert len(parts) == 1 and len(missing) == 1 and missing[0].startswith("w: is not shown: ")
    assert parts[0]["there"] == [0.5, None] and parts[0]["to"] == [0, 0, 0.2] and parts[0]["colour"] == view3d.SEEN
    assert [row[3] for row in parts[0]["pose"]] == [1, 2, 3, 1] and parts[0]["track"]["p"] == [[1, 2, 3], [2, 2, 3]]
    assert track["p"] == [[0, 0, 0], [1, 0, 0]]  # that of the data stays


def test_the_map_shows_the_epoch_with_most_cells(random):
    lattice = {"column_pitch_px": 40.0, "row_pitch_px": 20.0, "angle_deg": 0.0}
    table = {
        "epoch": [1.0] * 12 + [0.0],
        "row": [i // 4 for i in range(12)] + [0],
        "column": [i % 4 for i in range(12)] + [0],
    }
    table |= {"x_px": [0.3] * 12 + [9.0], "y_px": [0.4, -0.4] * 6 + [9.0]}
    places, deviations, factor = deviation_map(table, lattice)
    assert len(places) == 12 and np.abs(deviations).mean(axis=0) == pytest.approx([0.3, 0.4])
    assert factor == 20  # 0.8 * 20 / 0.4 = 40, and 1, 2 or 5 times a power of ten below
    for _ in range(longer(20)):  # a turned product has the same map
        angle = random.uniform(-180, 180)
        c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        x, y = np.array(table["x_px"]), np.array(table["y_px"])
        turned = deviation_map({**table, "x_px": c * x - s * y, "y_px": s * x + c * y}, {**lattice, "angle_deg": angle})
        np.testing.assert_allclose(turned[1], deviations, atol=1e-12)
        value = 10.0 ** random.uniform(-9, 9)
        assert round_below(value) <= value * (1 + 1e-12) < 2.5 * round_below(value) * (1 + 1e-9)
    assert deviation_map({key: [] for key in table}, lattice) is None
    assert deviation_map(table, {**lattice, "column_pitch_px": 0.0}) is None


def test_schema_of_several_and_optional_files(tmp_path, monkeypatch):
    schema = {
        "summary.json": {},
        "log/*.csv": {"t": "number", "q_*": "number", "word": "text", "q_mean": "number", "um?": "number"},
        "more.json?": {"x": "number"},
    }
    monkeypatch.setitem(data.SCHEMA, "visp-x", schema)
    (tmp_path / "summary.json").write_text('{"program": "visp-x"}')
    result = data.Result(tmp_path)
    with pytest.raises(data.DataError, match=r"log/\*\.csv: is missing"):
        result.files()
    (tmp_path / "log").mkdir()
    (tmp_path / "log/a.csv").write_text("t,q_a,q_b,word,q_mean\n1,2,,yes,4\n")
    (tmp_path / "log/b.csv").write_text("t,word,q_mean,um\n1,no,4,5\n")
    assert result.files() == ["log/a.csv", "log/b.csv"]
    first = result.table("log/a.csv")
    assert (
        list(first) == ["t", "q_a", "q_b", "word", "q_mean"] and np.isnan(first["q_b"][0]) and first["word"] == ["yes"]
    )
    assert result.table("log/b.csv")["um"] == [5.0]
    (tmp_path / "log/c.csv").write_text("t,q_a,q_mean,word\n")
    with pytest.raises(data.DataError, match="has the columns t,q_a,q_mean,word, must have t,q_a,word,q_mean"):
        result.table("log/c.csv")
    (tmp_path / "log/c.csv").write_text("t,word,q_mean\n1,no\n")
    with pytest.raises(data.DataError, match="log/c.csv:2: has 2 cells, must have 3"):
        result.table("log/c.csv")
    (tmp_path / "more.json").write_text(json.dumps({"x": "1"}))
    with pytest.raises(data.DataError, match='more.json.x is "1", must be number'):
        result.json("more.json")


def test_only_a_known_truth_is_in_the_legend():
    motion = {"frame": [0.0, 1.0, 2.0], "dx": [np.nan, 1.0, 1.1], "dy": [np.nan, 0.1, 0.0]}
    for truth in (np.nan, 1.0):
        svg = motion_figure({**motion, "true_dx": [np.nan, truth, truth], "true_dy": [np.nan, truth, truth]}).named("m", "motion").svg()
        assert ("true, x" in svg, "found, y" in svg) == (not np.isnan(truth), True)
