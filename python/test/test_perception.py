# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Obstacles as sensors see them: octrees, tracks of objects, maps from depth images."""
import numpy as np
import pytest
import visp_direct as vd
from conftest import longer, pose
from test_vision import rendered, texture

CAMERA = vd.CameraParameters(60, 60, 31.5, 23.5)


def plane(distance, rows=48, columns=64):
    return np.full((rows, columns), distance, np.float32)


def test_octrees_are_obstacles(arm, tmp_path):
    cells = np.array([[1, 2, 3, 0.1], [-1, 0, 0.5, 0.2]])
    octree = vd.Octree(cells, "made")
    np.testing.assert_array_equal(octree.cells(), cells)
    assert octree.label() == "made" and vd.Octree(np.zeros((0, 4))).cells().shape == (0, 4)
    shape = vd.CollisionShape.octree(octree)
    assert shape.type() == vd.ShapeType.Octree and shape.triangles() is None
    np.testing.assert_array_equal(shape.cubes().cells(), cells)
    assert vd.CollisionShape.sphere(1).cubes() is None
    tool = vd.ArmKinematics(arm, arm.home()).tool[:3, 3]
    scene = vd.CollisionScene(arm)
    assert not scene.inCollision(arm.home())
    scene.add(vd.CollisionObject(name="cube", shape=vd.CollisionShape.octree(vd.Octree([[*tool, 0.1]]))))
    assert scene.inCollision(arm.home())
    for bad, sentence in ((-0.1, "made: cell 0 has the size -0.1 m"), (np.nan, "size nan m")):
        with pytest.raises(ValueError, match=sentence):
            vd.Octree([[0, 0, 0, bad]], "made")
    with pytest.raises(ValueError, match=r"shape \(1, 3\) was given, must be n x 4 numbers"):
        vd.Octree(np.zeros((1, 3)))
    with pytest.raises(OSError, match="nowhere.bt"):
        vd.Octree.load("nowhere.bt")


def test_tracks_follow_a_moving_object(arm, random):
    for _ in range(longer(5)):
        spec = vd.ObjectTrackSpec(forget=1)
        spec.validate()
        tracks, velocity = vd.ObjectTracks(spec), random.uniform(-0.3, 0.3, 3)
        sigma, start = 0.002, random.uniform(1, 2, 3)
        for now in np.arange(0, 2, 0.05):
            seen = pose(start + now * velocity + random.normal(0, sigma, 3))
            sighting = vd.ObjectSighting(name="box", shape=vd.CollisionShape.sphere(0.1), pose=seen, time=now, positionSigma=sigma)
            assert tracks.add(sighting) and tracks.advance(now)
        (track,) = tracks.tracks()
        assert track.status == vd.TrackStatus.Tracked and tracks.find("box").name == "box" and tracks.find("other") is None
        np.testing.assert_allclose(track.velocity[:3], velocity, atol=6 * track.velocitySigma)
        np.testing.assert_allclose(track.pose[:3, 3], start + now * velocity, atol=6 * track.positionSigma)
        scene = vd.CollisionScene(arm)
        assert tracks.applyTo(scene) and scene.objectCount() == 1
        np.testing.assert_allclose(scene.object(0).pose, track.pose)
        assert tracks.advance(now + 0.6) and tracks.tracks()[0].status == vd.TrackStatus.Lost
        assert tracks.advance(now + 1.2) and tracks.tracks() == [] and tracks.applyTo(scene) and scene.objectCount() == 0
    assert not tracks.advance(np.nan) and not tracks.add(vd.ObjectSighting(name="", time=now))
    assert not tracks.add(vd.ObjectSighting(name="box", time=np.nan))
    with pytest.raises(ValueError, match="persistence"):
        vd.ObjectTracks(vd.ObjectTrackSpec(persistence=0))


def test_a_wall_seen_in_a_depth_image_is_mapped(arm, tmp_path):
    found = vd.DepthOctomap(vd.DepthOctomapSpec(resolution=0.05))
    fMc = pose([0.2, 0.3, 1.5])  # looks up, away from the arm
    report = found.insert(plane(0.8), CAMERA, fMc)
    assert report.status == vd.DepthStatus.Ok and report.used == 48 * 64 and report.invalid == 0 and report.message()
    cells = found.snapshot().cells()
    assert len(cells) > 100 and np.abs(cells[:, 2] - 2.3).max() <= 0.1
    found.save(str(tmp_path / "wall.bt"))
    loaded = vd.Octree.load(str(tmp_path / "wall.bt")).cells()
    assert (loaded[:, 3] ** 3).sum() == pytest.approx((cells[:, 3] ** 3).sum())
    found.clear()
    assert len(found.snapshot().cells()) == 0
    image = plane(0.8)
    image[:10], image[10:20], image[20:30] = np.nan, -1, np.inf
    report = found.insert(image, CAMERA, fMc)
    assert report.used == 18 * 64 and report.invalid == 30 * 64
    view = np.full((96, 64), 0.8, np.float32)[::2]  # not in sequence: is copied
    found.clear()
    assert found.insert(view, CAMERA, fMc).used == 48 * 64


def test_points_on_the_arm_and_on_known_objects_are_left_out(arm):
    scene, home = vd.CollisionScene(arm), arm.home()
    tool = vd.ArmKinematics(arm, home).tool[:3, 3]
    fMc = pose(tool - [0, 0, 0.5])  # below the tool, looks up at it
    with_arm, without = vd.DepthOctomap(), vd.DepthOctomap()
    assert without.insert(plane(0.5), CAMERA, fMc).body == 0
    report = with_arm.insert(plane(0.5), CAMERA, fMc, scene, home)
    assert 0 < report.body < 48 * 64 and report.used < 48 * 64
    spec = vd.DepthObstaclesSpec(map=vd.DepthOctomapSpec(resolution=0.05), name="seen")
    spec.validate()
    assert vd.DepthObstaclesSpec.defaultMap().stride == 4
    obstacles, above = vd.DepthObstacles(spec), pose([0.2, 0.3, 1.5])
    assert not obstacles.applyTo(scene)
    scene.add(vd.CollisionObject(name="ball", shape=vd.CollisionShape.sphere(0.2), pose=pose([0.2, 0.3, 2.3])))
    report = obstacles.insert(plane(0.8), CAMERA, above, scene, home)
    assert report.known > 0 and report.used > 0 and obstacles.applyTo(scene)
    cells = scene.object(scene.find("seen")).shape.cubes().cells()
    np.testing.assert_array_equal(cells, obstacles.snapshot().cells())
    assert np.linalg.norm(cells[:, :3] - [0.2, 0.3, 2.3], axis=1).min() > 0.15  # the ball is in the scene once
    obstacles.clear()
    assert obstacles.applyTo(scene) and scene.find("seen") < 0


def test_depth_images_of_other_kinds_are_refused(arm):
    found, scene, fMc = vd.DepthOctomap(), vd.CollisionScene(arm), pose([0, 0, 1])
    for image in (np.zeros((4, 4)), np.zeros((4, 4), np.uint16)):
        with pytest.raises(TypeError, match="float32"):
            found.insert(image, CAMERA, fMc)
    with pytest.raises(ValueError, match=r"shape \(4, 4, 1\)"):
        found.insert(np.zeros((4, 4, 1), np.float32), CAMERA, fMc)
    with pytest.raises(ValueError, match="scene and q are given both"):
        found.insert(plane(1), CAMERA, fMc, scene)
    with pytest.raises(ValueError, match="q has 3 numbers, the arm has 7 joints"):
        found.insert(plane(1), CAMERA, fMc, scene, [0, 0, 0])
    with pytest.raises(ValueError, match="q has a number that is not finite"):
        found.insert(plane(1), CAMERA, fMc, scene, np.full(7, np.nan))
    with pytest.raises(ValueError, match="resolution"):
        vd.DepthOctomap(vd.DepthOctomapSpec(resolution=-1))
    with pytest.raises(ValueError, match="name"):
        vd.DepthObstacles(vd.DepthObstaclesSpec(name=""))


def test_obstacles_are_found_by_their_photographs(random):
    """A box with a photograph, seen by a camera that moves: its pose in the base, its size, within its sigma."""
    camera, database = vd.CameraParameters(600, 600, 319.5, 239.5), vd.PlanarTargetDatabase(vd.CameraParameters(600, 600, 319.5, 239.5))
    picture = texture(random)
    database.add("box", picture, 0.16, 0.12, 0.05)
    spec = vd.ObstacleDetectorSpec(cameraPositionSigma=1e-4, cameraAngleSigma=1e-4)
    spec.validate()
    detector = vd.ObstacleDetector(database, camera, spec)
    assert len(database) == 0 and not database.process(np.zeros((480, 640), np.uint8))  # what it had is the detector's
    assert detector.detections()[0].status == vd.PlanarTargetStatus.NoFrame
    assert not vd.ObstacleDetector.fastTargets().fallback
    fMo = pose([0.5, 0.2, 0.9], [0.1, -0.2, 0.3])
    for k in range(longer(4)):
        fMc = pose([0.5 + 0.005 * k, 0.2, 0.6], [0, 0.01 * k, 0.3])
        image = rendered(picture, 0.16, 0.12, np.linalg.inv(fMc) @ fMo @ pose([0, 0, -0.025]), random)
        (found,) = detector.process(image, fMc, 0.1 * k)
        assert found.seen, found.message
        sighting = found.sighting
        assert sighting.name == "box" and sighting.time == 0.1 * k and sighting.shape.size() == pytest.approx([0.16, 0.12, 0.05])
        np.testing.assert_allclose(sighting.pose[:3, 3], fMo[:3, 3], atol=6 * sighting.positionSigma)
        np.testing.assert_allclose(sighting.pose[:3, :3], fMo[:3, :3], atol=6 * sighting.angleSigma)
    assert detector.targets()[0].name == "box" and vd.ObjectTracks().add(sighting)
    assert not detector.process(image, fMc, np.nan)[0].seen
    detector.reset()
    assert not detector.detections()[0].seen
    with pytest.raises(ValueError, match="has no target"):
        vd.ObstacleDetector(database, camera)
    with pytest.raises(TypeError, match="uint8"):
        detector.process(np.zeros((480, 640)), fMc, 1)
    database.add("again", picture, 0.16, 0.12)
    with pytest.raises(ValueError, match="thickness"):
        vd.ObstacleDetector(database, camera, vd.ObstacleDetectorSpec(thickness=0))
    assert len(database) == 1
