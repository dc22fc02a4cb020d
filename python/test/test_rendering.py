# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rendered images against a renderer in numpy, the places of cells, and depths of a sphere."""
import numpy as np
import pytest
import visp_direct as vd
from conftest import longer, pose
from test_vision import CAMERA, rendered, texture


def test_a_photograph_is_seen_as_by_numpy(random):
    photo = texture(random)
    view = vd.PlaneRenderer(photo, 0.16, 0.12, CAMERA, 640, 480)
    for seed in range(1, 1 + longer(3)):
        cMo = pose([*random.uniform(-0.03, 0.03, 2), random.uniform(0.25, 0.35)], random.uniform(-0.4, 0.4, 3))
        image, peer = view.render(cMo).astype(float), rendered(photo, 0.16, 0.12, cMo, random).astype(float)
        inside = peer > 100  # its background is 90
        assert inside.mean() > 0.05
        assert np.median(np.abs(image - peer)[inside]) < 5
        assert np.corrcoef(image[inside], peer[inside])[0, 1] > 0.98
        noisy = view.render(cMo, vd.CameraFaults(noise=3), seed)
        dark = (image > 20) & (image < 235)
        assert np.std((noisy - image)[dark]) == pytest.approx(3, rel=0.1)
        np.testing.assert_array_equal(noisy, view.render(cMo, vd.CameraFaults(noise=3), seed))
    with pytest.raises(ValueError, match="noise"):
        view.render(cMo, vd.CameraFaults(noise=-1))


def test_cells_of_a_product_are_where_they_are_said_to_be(random):
    spec = vd.ProductPatternSpec(shape=vd.ProductShape.Dot, pitchX=22, pitchY=18, openingX=10, openingY=10, noise=2, missing=0.1)
    spec.validate()
    product = vd.ProductPattern(spec)
    assert product.spec().pitchX == 22
    for frame in range(longer(5)):
        x, y = random.uniform(-1000, 1000, 2)
        image, expected, cells = product.render(x, y, frame=frame), product.expected(x, y), product.cells(x, y)
        assert image.dtype == np.uint8 and expected.dtype == np.float32 and image.shape == expected.shape == (100, 160)
        assert abs(np.mean(image - expected)) < 0.2
        assert cells.dtype == vd.PatternTruthCell and 20 < len(cells) < 60
        rows, columns = np.mgrid[0:100, 0:160]
        inside = (abs(cells["x"] - 79.5) < 71) & (abs(cells["y"] - 49.5) < 41)  # with the blur of its edge
        assert cells["complete"][inside].all()
        for cell in cells[inside]:
            window = np.hypot(columns - cell["x"], rows - cell["y"]) < 8
            weight = (expected[window] - 60).clip(0)
            assert weight.max() < 1 if cell["defective"] else weight.max() > 100
            if not cell["defective"]:
                assert np.average(columns[window], weights=weight) == pytest.approx(cell["x"], abs=0.05)
                assert np.average(rows[window], weights=weight) == pytest.approx(cell["y"], abs=0.05)


def test_depths_and_pictures_of_a_scene(arm, random):
    camera = vd.SceneCamera(vd.SceneCameraSpec(camera=CAMERA, photos=[vd.ScenePhoto(object="box", image=texture(random), size=[0.2, 0.15])]))
    (photo,) = camera.spec().photos
    assert photo.image.shape == (240, 320) and not photo.image.flags.writeable
    for seed in range(1, 1 + longer(3)):
        fMc = pose(random.uniform(-1, 1, 3), random.uniform(-1, 1, 3))
        centre, radius = np.array([*random.uniform(-0.1, 0.1, 2), random.uniform(0.8, 1.5)]), random.uniform(0.05, 0.2)
        scene = vd.CollisionScene(arm)
        ball = fMc @ pose(centre)
        scene.add(vd.CollisionObject(name="ball", shape=vd.CollisionShape.sphere(radius), pose=ball))
        depth = camera.depth(scene, fMc)
        assert depth.dtype == np.float32 and depth.shape == (480, 640)
        u, v = (np.array([CAMERA.u0, CAMERA.v0]) + CAMERA.px * centre[:2] / centre[2]).round().astype(int)
        ray = np.array([(u - CAMERA.u0) / CAMERA.px, (v - CAMERA.v0) / CAMERA.py, 1])
        t = np.roots([ray @ ray, -2 * ray @ centre, centre @ centre - radius**2]).min()
        assert depth[v, u] == pytest.approx(t, abs=1e-5) and (depth == 0).mean() > 0.5
        faulty = camera.depth(scene, fMc, vd.DepthFaults(noise=0.01, dropout=0.3), seed)
        seen = depth > 0
        assert (faulty[seen] == 0).mean() == pytest.approx(0.3, abs=0.05)
        there = seen & (faulty > 0)
        assert np.std((faulty - depth)[there] / depth[there] ** 2) == pytest.approx(0.01, rel=0.15)
        before = camera.picture(scene, fMc)
        box = vd.CollisionObject(name="box", shape=vd.CollisionShape.box([0.2, 0.15, 0.05]), pose=fMc @ pose([0, 0, 0.5]))
        scene.add(box)
        picture = camera.picture(scene, fMc, vd.CameraFaults(), seed)
        assert np.std(picture[200:280, 280:360].astype(float)) > 20 > np.std(before[:40, :40].astype(float))
    with pytest.raises(ValueError, match="dropout"):
        camera.depth(scene, fMc, vd.DepthFaults(dropout=2))
    with pytest.raises(ValueError):
        vd.DepthFaults(noise=-1).validate()
