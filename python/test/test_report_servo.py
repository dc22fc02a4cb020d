# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Reports of visp-servo-compare and visp-servo: sentences, marks, times, and the cameras of the 3D view. test_report.py opens them."""
import re

import numpy as np
import pytest
from browser import CHROMIUM, Browser
from conftest import longer, pose
from visp_direct.report.camera3d import NO_ARM, camera, chosen, columns, matrices, outline, plate
from visp_direct.report.data import Result
from visp_direct.report.page import Page, number
from visp_direct.report.servo import run_of, stairs
from visp_direct.report.servo_compare import cell_of, marks, route_of
from visp_direct.report.servo_figures import overshoot
from visp_direct.report.servo_laws import LOOKS, Comparison, Medians, answers, findings, listed
from visp_direct.report.servo_step import step_findings
from visp_direct.report.view3d import scene

try:
    import visp_direct as vd

    OURS = vd.ServoLaw.ids()  # before another test registers laws
except ImportError:
    OURS = None
METRICS = ("max_image_error_px", "rms_image_error_px", "end_rotation_deg", "yaw_range_deg", "out_of_view_s", "settle_s")
STEPS = ("peak_linear_acceleration_mps2", "peak_angular_acceleration_radps2")


class Made:
    """A result whose metrics are given by a function of law, plant, seed, measure and whether the run is shaped."""

    def __init__(self, laws, metrics, plants=("A", "D"), seeds=(1,), measures=("points",), shaped=False):
        self.summary = {
            "laws": [{"id": law} for law in laws],
            "plants": [{"name": plant, "deadband_radps": 0.2 if plant == "D" else 0.0} for plant in plants],
            "task": {"segments": []},
            "repetitions": len(seeds),
            "runs": [
                {"law": law, "plant": plant, "measure": measure, "seed": seed, "shaped": is_shaped, "status": "ok", "ideal_yaw_range_deg": 56.8}
                | dict.fromkeys((*METRICS, *STEPS), 0.0)
                | metrics(law, plant, seed, measure, is_shaped)
                for law in laws
                for plant in plants
                for measure in measures
                for is_shaped in ([False, True] if shaped else [False])
                for seed in seeds
            ],
        } | ({"shape": {}} if shaped else {})


def compared(laws, metrics, **more):
    return Comparison(Made(laws, metrics, **more))


def test_every_law_has_a_colour_of_its_own():
    assert len({paint for paint, _ in LOOKS.values()}) == len(LOOKS)
    c = compared(["ibvs", "ibvs+cbf", "mine", "hers", "mine+cbf"], lambda *_: {})
    assert c.look("ibvs+cbf") == c.look("ibvs")
    assert c.look("mine") == c.look("mine+cbf") != c.look("hers")
    assert OURS is None or set(OURS) == set(LOOKS)


def test_lists_read_well():
    assert [listed(x) for x in ([], ["a"], ["a", "b"], ["a", "b", "c"])] == ["", "a", "a and b", "a, b and c"]


def test_median_and_range_over_the_seeds(random):
    for _ in range(longer(50)):
        values = random.uniform(0, 10, random.integers(1, 8))
        c = compared(["ibvs"], lambda law, plant, seed, *_: {"settle_s": values[seed - 1]}, seeds=range(1, len(values) + 1))
        assert c.median("ibvs", "D", "settle_s") == pytest.approx(np.median(values))
        cell = cell_of(c.values("ibvs", "D", "settle_s"))
        assert cell.sort == pytest.approx(np.median(values)) and ("[" in cell.text) == (len(values) > 1)
    assert c.median("ibvs", "D", "settle_s", "image") is None
    assert cell_of([1.0, float("inf")]).text == "unknown"


def test_answer_follows_from_the_numbers():
    laws = ["kyrki-rot2", "ff-lookat", "ff-lookat-pi"]

    def answer(*ends):
        return answers(compared(laws, lambda law, *_: {"end_rotation_deg": ends[laws.index(law)]}))

    assert answer(5, 5.2, 0.1)[0] == (
        "On plant D (friction 0.2 rad/s), only 1 of 3 laws ends within 0.2° of every goal: ff-lookat-pi (0.1°); the next is kyrki-rot2 (5°)."
    )
    assert "tie on plant D" in answer(5, 5.2, 0.1)[1] and "but the integral of ff-lookat-pi does" in answer(5, 5.2, 0.1)[1]
    assert "but the integral of ff-lookat-pi does" not in answer(5, 5.2, 3)[1]
    assert "differ on plant D" in answer(5, 2, 0.1)[1]
    assert "none of the 3 laws ends within 0.2° of every goal; the closest is ff-lookat-pi" in answer(5, 2, 0.3)[0]
    assert "all 3 laws end within" in answer(0.1, 0.1, 0.1)[0] and "2 of 3 laws end within" in answer(0.1, 3, 0.1)[0]


def test_laws_tie_as_defined(random):
    for _ in range(longer(200)):
        a, b = (Medians(compared(["ibvs"], lambda *_: {}), "ibvs", "D") for _ in range(2))
        for m in (a, b):
            m.yaw, m.rms, m.rotation = 50 + random.uniform(0, 3), random.choice([2, 50]) + random.uniform(0, 12), random.uniform(0, 1)
        close = abs(a.yaw - b.yaw) < 2 and abs(a.rms - b.rms) < max(2, 0.1 * max(a.rms, b.rms)) and abs(a.rotation - b.rotation) < 0.5
        assert a.ties(b) == b.ties(a) == close


def test_findings_name_what_happened():
    def metrics(law, plant, seed, measure, shaped):
        worse = {"pbvs1": 8.0, "kyrki-decoupled": 9.0}.get(law, 1.0)
        image = 2.0 if measure == "image" else 0.0
        return {
            "end_rotation_deg": worse + image,
            "rms_image_error_px": 10 * worse,
            "yaw_range_deg": 50 - worse,
            "max_image_error_px": 90.0 if law == "pbvs1-rot2" else 15.0,
            "out_of_view_s": {"pbvs1+cbf": 1.5, "ibvs": 2.5}.get(law, 0.0) if plant == "D" else 0.0,
            "status": "target lost" if law == "ibvs" and plant == "A" else "ok",
        }

    laws = ["pbvs1", "pbvs1+cbf", "pbvs1-rot2", "kyrki-decoupled", "ff-sum", "ff-lookat", "ibvs"]
    said = "\n".join(findings(compared(laws, metrics, measures=("points", "image"))))
    for piece in (
        "by up to 90 px with pbvs1-rot2 and by up to 15 px with ff-lookat on plant A.",
        "The order of the thesis (its law at least as good as PBVS and Kyrki, figures 5.8 to 5.10) holds on plant D",
        "leaves the image on plant D (friction 0.2 rad/s) with pbvs1+cbf (1.5 s) and ibvs (2.5 s).",
        "a corner is lost in spite of it: pbvs1+cbf (1.5 s).",
        "ff-sum 3° instead of 1° and 10 instead of 10 px rms",
        "Runs that did not end well: ibvs on A by points (seed 1): target lost and ibvs on A by image (seed 1): target lost.",
    ):
        assert piece in said, piece
    laws = ["ff-sum", "pbvs1", "kyrki-decoupled"]
    for metric, worse in (("yaw_range_deg", -1.0), ("out_of_view_s", 1.0), ("rms_image_error_px", 1.0), ("end_rotation_deg", 1.0)):
        said = "\n".join(findings(compared(laws, lambda law, *_: {metric: 50 + worse * (law == "ff-sum")})))
        assert "does not hold in all figures" in said
    said = "\n".join(findings(compared(laws, lambda *_: {})))
    assert "No law lets a corner" in said and "did not end well" not in said


def test_cost_of_shaping_follows_from_the_numbers():
    def findings_with(lost, plants=("A",)):
        def metrics(law, plant, seed, measure, shaped):
            ibvs = law == "ibvs"
            return {
                "peak_linear_acceleration_mps2": 1.0 if shaped else 22.36 if ibvs else 30.0,
                "peak_angular_acceleration_radps2": (2.5 if ibvs else 2.0) if shaped else 49.6,
                "max_image_error_px": (15.0 if ibvs else 40.0) if shaped else 10.0,
                "end_rotation_deg": 0.25,
                "settle_s": (4.0 if ibvs else 3.5) if shaped else 3.0,
                "out_of_view_s": lost if shaped and not ibvs else 0.0,
            }

        return step_findings(compared(["ibvs", "pbvs1+cbf"], metrics, plants=plants, shaped=True))

    said = findings_with(0.7)
    assert len(said) == 4 and len(findings_with(0.7, ("A", "D"))) == 5  # one plant: its cost is reported once
    assert said[0] == (
        "Over all laws and plants the command asks for accelerations of up to 30 m/s² and 49.6 rad/s² raw, and of up to 1 m/s² and 2.5 "
        "rad/s² shaped."
    )
    assert said[1] == (
        "What it costs on plant A: the largest image error rises most with pbvs1+cbf, from 10 to 40 px; the rotation error at the end rises "
        "with no law; the time to settle rises most with ibvs, from 3 to 4 s; the time out of view rises most with pbvs1+cbf, from 0 to 0.7 s."
    )
    assert "promises nothing. Longer out of view for that: pbvs1+cbf on plant A (0 s raw, 0.7 s shaped)." in said[2]
    assert "In these runs no filtered law is longer out of view" in findings_with(0.0)[2]


def test_best_and_worst_are_marked_as_displayed(random):
    c = compared(["ibvs"], lambda *_: {})
    assert marks(c, {"a": 1.0, "b": 2.0, "c": 3.0}, "least") == {"a": "best", "c": "worst"}
    assert marks(c, {"a": 1.0001, "b": 1.0002, "c": 3.0}, "least") == {"c": "worst"}  # two of three look the same: not the best
    assert marks(c, {"a": 56.8, "b": 50.0, "c": 70.0}, "ideal") == {"a": "best", "c": "worst"}  # too far is as wrong
    assert marks(c, {"a": 1.0, "b": 2.0}, "") == marks(c, {"a": 1.0}, "least") == marks(c, {"a": 1.0, "b": 1.0}, "least") == {}
    for _ in range(longer(100)):
        medians = {f"law{i}": float(x) for i, x in enumerate(random.uniform(1, 9, random.integers(3, 9)))}
        found = marks(c, medians, "least")
        texts = {law: number(m) for law, m in medians.items()}  # what a reader sees
        for word, extreme in (("best", min), ("worst", max)):
            text = texts[extreme(medians, key=medians.get)]
            sharing = [law for law in medians if texts[law] == text]
            assert [law for law in medians if found.get(law) == word] == (sharing if 2 * len(sharing) <= len(medians) else [])


def test_route_begins_where_the_start_is():
    place = {"position_m": [0, 0, 0.5], "rotation_deg": [0, 0, 0]}
    other = {"position_m": [0.1, 0, 0.5], "rotation_deg": [0, 0, 0]}
    assert route_of({"start": place, "segments": [{"name": "2"} | other, {"name": "1"} | place]}) == "1 – 2 – 1"
    assert route_of({"start": place, "segments": [{"name": "2"} | other]}) == "start – 2"


def test_overshoot_is_beyond_the_goal_in_the_direction_of_the_turn():
    logs = {"goal_yaw_rad": np.radians([30, 30, 30, 10, 10]), "reference_yaw_rad": np.radians([10, 34, 30, 3, 10])}

    class Log:
        def log(self, law, plant):
            return logs

    assert overshoot(Log(), "x", "D") == pytest.approx(7)
    logs["reference_yaw_rad"] = np.radians([10, 20, 30, 20, 10])
    assert overshoot(Log(), "x", "D") == pytest.approx(0)


def test_times_have_no_gaps():
    edges, shares = stairs([[0, 1, 3], [1, 2, 1], [8, 9, 4]])
    assert edges == [1e-4, 1, 2, 8, 9] and shares == [37.5, 12.5, 0, 50]


# The cameras of the 3D view.


def test_poses_of_rotation_vectors(random):
    for _ in range(longer(100)):
        t, r = random.normal(size=(2, 5, 3)) * random.choice([1e-9, 0.1, 1.0])
        found = matrices(t, r)
        for k in range(5):
            np.testing.assert_allclose(found[k], pose(t[k], r[k]), atol=1e-12)
    table = {f"a_{kind}": [0.1 * i] for i, kind in enumerate(("tx", "ty", "tz", "tux", "tuy", "tuz"))}
    np.testing.assert_allclose(columns(table, "a_")[0], pose([0, 0.1, 0.2], [0.3, 0.4, 0.5]), atol=1e-12)


def test_outline_is_where_the_corners_are_seen(random):
    for _ in range(longer(100)):
        size, cMo = random.uniform(0.05, 0.3, 2), pose(random.uniform(-0.1, 0.1, 3) + [0, 0, 0.6], random.normal(size=3) * 0.4)
        for (x, y), (sx, sy) in zip(outline(cMo, size), [(-1, -1), (1, -1), (1, 1), (-1, 1)]):
            p = cMo[:3, :3] @ [sx * size[0] / 2, sy * size[1] / 2, 0] + cMo[:3, 3]
            np.testing.assert_allclose([x, y], p[:2] / p[2], atol=1e-5)
    assert outline(pose([0, 0, 0.01], [1.5, 0, 0]), [0.2, 0.2]) == []  # a corner behind the camera


def test_lens_has_the_corners_of_the_image(random):
    intrinsics = {"px": 600.0, "py": 610.0, "u0": 300.0, "v0": 250.0, "width": 640, "height": 480}
    made = camera(intrinsics, [np.eye(4)], 0.1, [])
    u = np.array(made["lens"][:2]) * 600 + 300
    v = np.array(made["lens"][2:]) * 610 + 250
    np.testing.assert_allclose([*u, *v], [-0.5, 639.5, -0.5, 479.5])
    assert made["pose"] == [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]]
    for count in (1, 2, 239, 240, 241, 5000):
        index = chosen(count)
        assert index[0] == 0 and index[-1] == count - 1 and len(index) == min(count, 240)


@pytest.mark.parametrize("stands", [False, True])
def test_camera_of_a_run_is_where_the_log_says(stands, tmp_path, random):
    """A camera that moves, or one that stands and sees a target on the robot."""
    count, place = 5, pose(random.normal(size=3), random.normal(size=3))
    poses = [place if stands else pose(random.normal(size=3), random.normal(size=3)) for _ in range(count)]
    cMo = [pose([0, 0, 0.4 + 0.01 * i], [0, 0.1, 0]) for i in range(count)]
    six = {f"{name}_{kind}": [] for name in ("fMe" if stands else "fMc", "cMo") for kind in ("tx", "ty", "tz", "tux", "tuy", "tuz")}
    for name, list_of in (("cMo", cMo), *([] if stands else [("fMc", poses)])):
        for M in list_of:
            angle = np.arccos(np.clip((np.trace(M[:3, :3]) - 1) / 2, -1, 1))
            axis = np.array([M[2, 1] - M[1, 2], M[0, 2] - M[2, 0], M[1, 0] - M[0, 1]]) / (2 * np.sin(angle))
            for kind, x in zip(("tx", "ty", "tz", "tux", "tuy", "tuz"), (*M[:3, 3], *(angle * axis))):
                six[f"{name}_{kind}"].append(x)
    intrinsics = {"px": 600, "py": 600, "u0": 320, "v0": 240, "width": 640, "height": 480}
    looked_at = {"camera": intrinsics, "size_m": [0.1, 0.1], "goal": None, "picture": None} | ({"fMc": place.tolist()} if stands else {})
    result = type("Made", (), {"summary": {"scene": looked_at}, "folder": tmp_path, "name": "made"})
    log = six | {"time_s": list(range(count)), "distance_m": [0] * count}
    run, _, target, _ = run_of(result, log, np.eye(4))
    np.testing.assert_allclose(np.reshape(run["camera"]["pose"], (count, 3, 4)), np.array(poses)[:, :3], atol=1e-5)
    np.testing.assert_allclose(target[0]["track"]["pose"], np.array(poses) @ np.array(cMo), atol=2e-5)
    if stands:
        del looked_at["fMc"]
        assert run_of(result, log, np.eye(4)) is None  # not told


@pytest.mark.skipif(CHROMIUM is None, reason="chromium is missing")
def test_camera_without_goal_or_target_is_shown(tmp_path):
    """As for a target of unknown size, or one that was never seen."""
    intrinsics = {"px": 600, "py": 600, "u0": 320, "v0": 240, "width": 640, "height": 480}
    page = Page("Cameras", "")
    page.section("Views")
    for objects in ([], [plate([0.1, 0.1], pose([0, 0, 0.4]))]):
        seen = camera(intrinsics, [pose([0, 0, 0.1 * i]) for i in range(3)], 0.1, [])
        run = {"name": "made", "colour": "#0072b2", "arm": 0, "t": [0, 1, 2], "q": [[]] * 3, "camera": seen}
        page.view(scene([NO_ARM], [run], objects), "")
    file = tmp_path / "page.html"
    file.write_text(page.html())
    browser = Browser()
    browser.open(file)
    assert not browser.messages
    assert browser.evaluate("document.querySelectorAll('[aria-label=time]').length") == 2
    browser.close()


def test_long_logs_are_thinned(tmp_path):
    (tmp_path / "summary.json").write_text('{"program": "visp-print-pattern --none"}')
    (tmp_path / "x.csv").write_text("a,b\n" + "".join(f"{i},{2 * i}\n" for i in range(1000)))
    result = Result(tmp_path)
    assert result.table("x.csv", ["a", "b"])["a"] == list(range(1000))
    thin = result.table("x.csv", ["a", "b"], most=100)
    assert thin["a"] == list(range(0, 1000, 10)) and thin["b"] == [2 * a for a in thin["a"]]
    assert re.match(r"\w+", result.name)
