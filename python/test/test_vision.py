# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Planar targets, patterns and calibrations on images and points that numpy makes."""
import resource

import numpy as np
import pytest
import visp_direct as vd
from conftest import DATA, longer, pose

CAMERA = vd.CameraParameters(600, 600, 319.5, 239.5)
K = np.array([[600, 0, 319.5], [0, 600, 239.5], [0, 0, 1]])


def texture(random, rows=240, columns=320):
    """Smooth blobs: enough corners for a detector."""
    image = random.uniform(0, 1, (rows, columns))
    for axis in (0, 1):
        for _ in range(3):
            image = (np.roll(image, 1, axis) + image + np.roll(image, -1, axis)) / 3
    image = (image - image.min()) / np.ptp(image)
    return (255 * np.clip(3 * (image - 0.35), 0, 1)).astype(np.uint8)


def bilinear(image, u, v):
    inside = (u >= 0) & (v >= 0) & (u <= image.shape[1] - 1.001) & (v <= image.shape[0] - 1.001)
    u, v = np.where(inside, u, 0), np.where(inside, v, 0)
    i, j = v.astype(int), u.astype(int)
    a, b = v - i, u - j
    f = image.astype(float)
    value = (1 - a) * ((1 - b) * f[i, j] + b * f[i, j + 1]) + a * ((1 - b) * f[i + 1, j] + b * f[i + 1, j + 1])
    return np.where(inside, value, 90)


def rendered(reference, width, height, cMo, random):
    """The plane z = 0 with the reference, width x height m, as the camera sees it; noise of 2 grey values."""
    rows, columns = reference.shape
    v, u = np.mgrid[0:480, 0:640]
    H = K @ cMo[:3, [0, 1, 3]]
    X = np.einsum("ij,jkl->ikl", np.linalg.inv(H), np.stack([u, v, np.ones_like(u)]).astype(float))
    x, y = X[0] / X[2], X[1] / X[2]
    seen = bilinear(reference, (x / width + 0.5) * columns - 0.5, (y / height + 0.5) * rows - 0.5)
    return np.clip(seen + random.normal(0, 2, seen.shape), 0, 255).astype(np.uint8)


def test_planar_target_finds_its_pose(random):
    reference = texture(random)
    target = vd.PlanarTarget(reference, 0.16, 0.12, CAMERA, vd.PlanarTargetSpec(maxKeypoints=1000))
    assert (target.width(), target.height()) == (0.16, 0.12)
    for _ in range(longer(3)):
        cMo = pose([*random.uniform(-0.03, 0.03, 2), random.uniform(0.25, 0.35)], random.uniform(-0.4, 0.4, 3))
        image = rendered(reference, 0.16, 0.12, cMo, random)
        target.reset()
        for result in (
            target.acquire(image),
            target.process(image),
            target.track(image),
            target.track(image, cMo),
            target.result(),
        ):
            assert result.found(), result.message
            np.testing.assert_allclose(result.cMo[:3, 3], cMo[:3, 3], atol=1e-3)
            np.testing.assert_allclose(result.cMo[:3, :3], cMo[:3, :3], atol=1e-2)
        assert result.covariance.known and 0 < result.covariance.positionDeviation() < 1e-3
        assert 0 < result.covariance.rotationDeviation() < 1e-2
        np.testing.assert_allclose(result.covariance.C, result.covariance.C.T)
        corners = (
            K
            @ cMo[:3]
            @ np.array([[-0.08, -0.06, 0, 1], [0.08, -0.06, 0, 1], [0.08, 0.06, 0, 1], [-0.08, 0.06, 0, 1]]).T
        )
        np.testing.assert_allclose(result.corners, (corners[:2] / corners[2]).T, atol=1)
        mapped = result.homography @ [-0.5, -0.5, 1]
        np.testing.assert_allclose(mapped[:2] / mapped[2], result.corners[0], atol=1)
    target.reset()
    assert not target.process(np.full((480, 640), 90, np.uint8)).found()


def test_database_finds_each_of_its_targets(random):
    pictures = [texture(random), texture(random)]
    database = vd.PlanarTargetDatabase(CAMERA)
    for name, picture in zip("ab", pictures):
        database.add(name, picture, 0.16, 0.12, 0.02)
    cMo = pose([0, 0, 0.3])
    image = rendered(pictures[1], 0.16, 0.12, cMo, random)
    for _ in range(4):
        sightings = database.process(image)
    assert len(database) == 2 and [s.name for s in sightings] == ["a", "b"] and sightings[1].depth == 0.02
    assert [s.result.found() for s in database.sightings()] == [False, True]
    assert database.effort().followed == 1
    database.predict(1, cMo)
    database.reset()
    assert len(vd.PlanarTargetDatabase.fromFolder(str(DATA / "target"), CAMERA)) >= 2
    with pytest.raises(IndexError, match="target 2 does not exist, there are 2"):
        database.predict(2, cMo)
    with pytest.raises(OSError, match="nowhere"):
        vd.PlanarTargetDatabase.fromFolder("nowhere", CAMERA)


def dots(shift=(0.0, 0.0), pitch=(22.0, 18.0), size=(160, 240), noise=None):
    """Round bright cells on a lattice, their true centres, and the image."""
    v, u = np.mgrid[0 : size[0], 0 : size[1]].astype(float)
    x = (u - shift[0] + pitch[0] / 2) % pitch[0] - pitch[0] / 2
    y = (v - shift[1] + pitch[1] / 2) % pitch[1] - pitch[1] / 2
    image = 60 + 120 / (1 + np.exp((np.hypot(x, y) - 5.5) / 0.7))
    return np.clip(image + (0 if noise is None else noise.normal(0, 2, image.shape)), 0, 255).astype(np.uint8)


def test_pattern_tracker_measures_motion_and_places(random):
    tracker = vd.PatternTracker(240, 160, vd.PatternTrackerSpec(learningFrames=4))
    tracker.spec().check()
    shift, motion = np.array([5.3, 7.1]), random.uniform(-3, 3, 2)
    for k in range(40):
        shift += motion
        frame = tracker.process(dots(shift, noise=random))
        if k > 20:
            assert frame.status == vd.PatternStatus.Tracking, frame.message()
            np.testing.assert_allclose([frame.dx, frame.dy], motion, atol=0.05)
            valid = frame.cells[frame.cells["valid"]]
            assert len(valid) == frame.validCells >= 20
            np.testing.assert_allclose((valid["x"] - shift[0] + 11) % 22, 11, atol=0.2)
            np.testing.assert_allclose((valid["y"] - shift[1] + 9) % 18, 9, atol=0.2)
    lattice = tracker.frame().lattice
    assert lattice.columnPitch() == pytest.approx(22, abs=0.05) and lattice.rowPitch() == pytest.approx(18, abs=0.05)
    assert lattice.angle() == pytest.approx(0, abs=5e-3)
    tracker.interrupt()
    assert tracker.process(dots(shift)).epoch > frame.epoch
    tracker.reset()
    assert tracker.process(np.zeros((10, 10), np.uint8)).reason == vd.PatternReason.WrongSize


def test_images_are_checked_and_not_copied():
    tracker = vd.PatternTracker(240, 160)
    for given, error, sentence in (
        (np.zeros((160, 240)), TypeError, "an image of float64 was given, must be uint8"),
        (np.zeros((160, 240), np.uint16), TypeError, "an image of uint16 was given, must be uint8"),
        (np.zeros((160, 240, 3), np.uint8), ValueError, r"shape \(160, 240, 3\) was given, an image has 2"),
        (np.zeros((0, 240), np.uint8), ValueError, "is not empty"),
        ([[1, 2]], TypeError, "a list was given, an image is a 2-D array of uint8"),
    ):
        with pytest.raises(error, match=sentence):
            tracker.process(given)
    image = dots()
    assert tracker.process(np.asfortranarray(image)).status == tracker.process(image).status
    large = np.ones((16000, 16000), np.uint8)  # of the wrong size, which the tracker sees without reading it
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    tracker.process(large)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 50000  # kB; the image has 250000


def test_microscope_calibration_finds_the_scale(random):
    pitch = vd.CalibrationPitch(columns=220e-6, rows=180e-6)
    pitch.check()
    calibration = vd.PlanarMicroscopeCalibration(
        240, 160, vd.MicroscopeCalibrationSpec(estimateKappa1=False, estimateTilt=False)
    )
    tracker = vd.PatternTracker(240, 160, vd.PatternTrackerSpec(learningFrames=2))
    for _ in range(12):
        frame = tracker.process(dots((3.2, 4.4), noise=random))
    points = vd.calibrationPoints(frame, pitch)
    assert points.dtype == vd.CalibrationPoint
    calibration.addView(points)
    result = calibration.compute()
    assert calibration.viewCount() == 1 and result.calibration.scaleX == pytest.approx(22 / 220e-6, rel=2e-3)
    assert 0 < result.sigma(vd.MicroscopeParameter.MicroscopeScaleX) < 0.01 * result.calibration.scaleX
    found = result.calibration
    np.testing.assert_allclose(found.toImage(*found.toPlane(100, 60)), [100, 60], atol=1e-6)
    assert found.pixelSizeUm() == pytest.approx(10, rel=2e-3) and found.toCamera().px == pytest.approx(found.scaleX)
    assert len(vd.calibrationPoints(dots((3.2, 4.4), size=(320, 480)), pitch)) > 20
    assert isinstance(result.fit.message(result.varianceFactor), str)
    with pytest.raises(TypeError, match="must be an array of dtype visp_direct.CalibrationPoint"):
        calibration.addView(np.zeros(6))


def test_tsai_calibration_finds_the_camera(random):
    spec = vd.TsaiCalibrationSpec(estimateKappa1=False)
    spec.check()
    calibration = vd.TsaiCalibration(640, 480, spec)
    for _ in range(6):
        cMo = pose([*random.uniform(-0.05, 0.05, 2), random.uniform(0.5, 0.7)], random.uniform(-0.6, 0.6, 3))
        plane = np.c_[
            np.array(np.meshgrid(np.linspace(-0.1, 0.1, 7), np.linspace(-0.1, 0.1, 7))).reshape(2, -1).T, np.zeros(49)
        ]
        points = np.zeros(49, vd.CalibrationPoint)
        projected = K @ (cMo @ np.c_[plane, np.ones(49)].T)[:3]
        points["u"], points["v"] = projected[:2] / projected[2] + random.normal(0, 0.1, (2, 49))
        points["x"], points["y"], points["z"] = plane.T
        points["sigmaU"] = points["sigmaV"] = 0.1
        calibration.addView(points)
    result = calibration.compute()
    assert calibration.viewCount() == 6 and result.reliable, result.message
    for value, true, parameter in (
        (result.px, 600, vd.TsaiParameter.TsaiPx),
        (result.u0, 319.5, vd.TsaiParameter.TsaiU0),
    ):
        assert abs(value - true) < 5 * result.sigma(parameter) and result.sigma(parameter) < 5
    assert result.toCamera().px == result.px and len(result.cMo) == 6
    points["sigmaU"] = 0
    with pytest.raises(ValueError, match="sigmaU"):
        calibration.addView(points)


def test_camera_is_checked():
    assert (CAMERA.px, CAMERA.py, CAMERA.u0, CAMERA.v0, CAMERA.kud, CAMERA.kdu) == (600, 600, 319.5, 239.5, 0, 0)
    with pytest.raises(ValueError, match="must be > 0"):
        vd.CameraParameters(0, 600, 320, 240)
    with pytest.raises(ValueError, match="not finite"):
        vd.CameraParameters(np.nan, 600, 320, 240)
    with pytest.raises(ValueError, match="minCorrelation"):
        vd.PlanarTargetSpec(minCorrelation=2).validate()
    for spec in (
        vd.PatternTrackerSpec(minPitch=-1),
        vd.MicroscopeCalibrationSpec(aspect=-1),
        vd.CalibrationPitch(columns=-1),
        vd.TsaiCalibrationSpec(aspect=-1),
    ):
        with pytest.raises(ValueError, match="must be|is -1"):
            spec.check()
