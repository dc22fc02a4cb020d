# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes, certificates, planners and the servo of an arm; distances by brute force over points of the arm's capsules."""
import copy
import threading
import time

import numpy as np
import pytest
import visp_direct as vd
from conftest import DATA, longer, pose
from test_servo import plate

PILLAR = str(DATA / "scene/s4a-pillar.json")


def scene_of(arm, **fields):
    return vd.CollisionScene(arm, vd.CollisionSceneSpec(**fields))


def distance_by_points(scene, q, centre, radius):
    """Least distance of the arm's moving capsules from a sphere, by 100 points on each axis."""
    ends = scene.capsuleEnds(q).reshape(-1, 2, 3)
    s = np.linspace(0, 1, 100)[:, None]
    moving = [(e, c) for e, c in zip(ends, scene.arm().spec().capsules) if c.link > 0]
    return min(np.linalg.norm(e[0] + s * (e[1] - e[0]) - centre, axis=1).min() - c.radius for e, c in moving) - radius


def test_clearance_of_a_sphere(arm, random):
    for _ in range(longer(30)):
        centre, radius = random.uniform(-0.8, 0.8, 3), random.uniform(0.05, 0.2)
        scene = scene_of(
            arm, objects=[vd.CollisionObject(name="ball", shape=vd.CollisionShape.sphere(radius), pose=pose(centre))]
        )
        q = random.uniform(np.maximum(arm.lower(), -3), np.minimum(arm.upper(), 3))
        pairs = [p for p in scene.near(q, 10) if p.kind == vd.CollisionKind.Object]
        least = min(p.distance for p in pairs)
        assert least == pytest.approx(distance_by_points(scene, q, centre, radius), abs=2e-3)
        nearest = scene.clearance(q)
        assert nearest.distance <= least + 1e-12 and scene.describe(nearest)
        assert scene.inCollision(q, nearest.distance + 1e-9) and not scene.inCollision(q, nearest.distance - 1e-9)


def test_objects_come_move_and_go(arm):
    scene = scene_of(arm, ground=vd.HalfSpace(firstLink=3))
    other = copy.copy(scene)
    box = vd.CollisionObject(name="box", shape=vd.CollisionShape.box([0.1, 0.2, 0.3]), velocity=[1, 0, 0, 0, 0, 0])
    np.testing.assert_allclose(box.poseAt(2)[:3, 3], [2, 0, 0])
    assert scene.add(box) == 0 and scene.find("box") == 0 and scene.objectCount() == 1 and other.objectCount() == 0
    assert scene.moveObject(0, pose([1, 0, 0])) and scene.setInflation(0, 0.01)
    assert scene.setVelocity(0, [0, 0, 0.5, 0, 0, 0]) and scene.advance(2)
    np.testing.assert_allclose(scene.object(0).pose[:3, 3], [1, 0, 1])
    assert scene.object(0).inflation == 0.01 and scene.capsuleCount() == len(arm.spec().capsules)
    assert len(scene.selfPairs()) > 0 and scene.ground().firstLink == 3 and scene.arm().size() == arm.size()
    scene.remove(0)
    assert scene.objectCount() == 0 and not scene.setInflation(0, 0.1)
    for call, sentence in (
        (lambda: scene.remove(3), "3"),
        (lambda: scene.add(vd.CollisionObject(name="")), "name"),
        (lambda: scene.inCollision([0, 0]), "q has 2 numbers, the arm has 7 joints"),
    ):
        with pytest.raises(ValueError, match=sentence):
            call()
    with pytest.raises(IndexError, match="object 5 does not exist, there are 0"):
        scene.object(5)
    assert (
        scene.inCollision(np.full(7, np.nan)) and scene.clearance(np.full(7, np.nan)).kind == vd.CollisionKind.Unknown
    )
    assert len(scene.capsuleEnds(np.full(7, np.nan))) == 0
    with pytest.raises(IndexError):
        scene.describe(vd.Clearance(kind=vd.CollisionKind.Object, capsule=0, other=99))


def test_shapes_and_meshes(tmp_path):
    Shape = vd.CollisionShape
    shapes = [Shape.sphere(0.1), Shape.capsule(0.1, 0.2), Shape.box([1, 2, 3]), Shape.cylinder(0.1, 0.2)]
    assert [s.type() for s in shapes] == [
        vd.ShapeType.Sphere,
        vd.ShapeType.Capsule,
        vd.ShapeType.Box,
        vd.ShapeType.Cylinder,
    ]
    assert shapes[1].radius() == 0.1 and shapes[1].length() == 0.2 and (shapes[2].size() == [1, 2, 3]).all()
    assert shapes[0].triangles() is None
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    mesh = vd.TriangleMesh(vertices, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], "corner")
    assert mesh.isWatertight() and mesh.message() == "" and mesh.label() == "corner"
    np.testing.assert_array_equal(np.sort(mesh.vertices(), axis=0), np.sort(vertices, axis=0))
    assert mesh.triangles().shape == (4, 3) and Shape.mesh(mesh).triangles().label() == "corner"
    assert len(vd.TriangleMesh.load(str(DATA / "scene/bracket.obj")).triangles()) > 4
    for call, sentence in (
        (lambda: Shape.sphere(-1), "radius"),
        (lambda: Shape.mesh(vd.TriangleMesh(vertices, [[0, 1, 2]])), "holes"),
        (lambda: vd.TriangleMesh(vertices, [[0, 1, 9]]), "9"),
        (lambda: Shape.box([1, 2]), "must be 3 numbers"),
    ):
        with pytest.raises(ValueError, match=sentence):
            call()


def test_certificate_is_a_proof(arm, random):
    loaded = vd.loadCollisionScene(PILLAR)
    scene = vd.CollisionScene(arm, loaded.spec)
    motion = vd.CertifiedMotion(scene, vd.CertifiedMotionSpec(margin=0.01))
    assert motion.spec().margin == 0.01
    free = 0
    for _ in range(longer(100)):
        start, end = (random.uniform(np.maximum(arm.lower(), -3), np.minimum(arm.upper(), 3)) for _ in range(2))
        end = start + 0.3 * (end - start)
        result = motion.check(start, end)
        sampled = [scene.inCollision(start + s * (end - start), 0.01) for s in np.linspace(0, 1, 200)]
        assert not (result.isFree() and any(sampled)), result.message()
        free += result.isFree()
        if result.status == vd.MotionStatus.Collision:
            assert scene.inCollision(start + result.s * (end - start), 0.01)
    assert 5 < free < longer(100)
    assert motion.check([0.0], [1.0]).status == vd.MotionStatus.BadInput


def test_planner_and_timed_path(arm):
    loaded = vd.loadCollisionScene(PILLAR)
    scene, task = vd.CollisionScene(arm, loaded.spec), loaded.tasks[0]
    spec = vd.PathPlannerSpec(timeLimit=20, margin=0.01)
    spec.validate()
    planner = vd.PathPlanner(scene, spec)
    planner.setSeed(3)
    planner.setTimeLimit(20)
    result = planner.plan(task.start, task.goal)
    assert result.status == vd.PathStatus.Solved and planner.spec().margin == 0.01, result.message
    points = result.path.points
    assert result.path.length() == pytest.approx(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    np.testing.assert_allclose(result.path.at(1), task.goal)
    for s in np.linspace(0, 1, 200):
        assert not scene.inCollision(result.path.at(s), 0.01)
    timed = vd.TimedPath(scene, result.path, vd.TimedPathSpec(margin=0.005))
    assert timed.isFree(), timed.message(scene)
    assert timed.clearance().isFree() and timed.duration() > 0
    np.testing.assert_allclose([timed.at(j, timed.duration())[0] for j in range(7)], task.goal, atol=1e-9)
    certificate = vd.CertifiedTrajectory(scene, vd.CertifiedMotionSpec(margin=0.005))
    for _, plan in timed.parts():
        assert certificate.check(plan).isFree() and certificate.check(plan, 0, plan.duration() / 2).isFree()
    certificate.setMargin(0.5)
    assert not certificate.check(timed.parts()[0][1]).isFree()
    assert vd.PathPlannerSpec().planner == "BiRRT" and "RRTConnect" in vd.PathPlanner.names()
    with pytest.raises(ValueError, match="the path is empty"):
        vd.JointPath().at(0.5)
    with pytest.raises(ValueError, match="RRTConnect"):
        vd.PathPlanner(scene, vd.PathPlannerSpec(planner="none"))
    assert planner.plan([0.0], [1.0]).status == vd.PathStatus.BadInput


def test_planning_does_not_hold_the_interpreter(arm):
    loaded = vd.loadCollisionScene(PILLAR)
    scene, task = vd.CollisionScene(arm, loaded.spec), loaded.tasks[0]
    planner = vd.PathPlanner(scene, vd.PathPlannerSpec(planner="RRTstar", stopAtFirst=False, timeLimit=1))
    thread = threading.Thread(target=lambda: planner.plan(task.start, task.goal))
    thread.start()
    turns = 0
    while thread.is_alive():
        time.sleep(0.01)
        turns += 1
    assert turns > 10


def test_goal_configuration(arm):
    scene = scene_of(arm)
    wanted = vd.ArmKinematics(arm, arm.home()).tool[:3, 3] + [0, 0, -0.05]
    goal = vd.findGoalConfiguration(scene, arm.home(), wanted, attempts=50)
    assert goal.isFree() and goal.message().startswith("Free: ")
    np.testing.assert_allclose(vd.ArmKinematics(arm, goal.q).tool[:3, 3], wanted, atol=1e-3)
    assert (
        vd.findGoalConfiguration(scene, arm.home(), [9, 9, 9], attempts=1).status
        == vd.GoalConfigurationStatus.Unreachable
    )


def test_avoidance_methods_arrive(arm):
    scene = scene_of(arm)
    goal = vd.AvoidanceGoal.at(arm, np.clip(arm.home() + 0.3, arm.lower() + 0.1, arm.upper() - 0.1))
    assert goal.fits(arm)
    for name in ("dtg", "planner"):
        if name not in vd.avoidanceMethodNames():
            name = vd.avoidanceMethodNames()[-1]
        spec = vd.AvoidanceMethodSpec(period=0.01)
        spec.validate()
        method = vd.makeAvoidanceMethod(name, scene, spec)
        q = arm.home()
        method.start(q, goal)
        method.setGoal(goal)
        for k in range(3000):
            if k % 10 == 0:
                method.look()
            output = method.step(q)
            q = q + 0.01 * output.velocity
            if not vd.isWorking(output):
                break
        assert output.status == vd.AvoidanceStatus.Arrived, (name, output.message())
        np.testing.assert_allclose(vd.ArmKinematics(arm, q).tool[:3, 3], goal.position, atol=2e-3)
    with pytest.raises(ValueError, match="none"):
        vd.makeAvoidanceMethod("none", scene)


def test_supervisor_stops_before_an_obstacle(arm, random):
    q, stopped = vd.loadCollisionScene(PILLAR).tasks[0].start, False
    reach = vd.ArmKinematics(arm, q).tool[:3, 3]
    wall = vd.CollisionObject(name="wall", shape=vd.CollisionShape.box([4, 0.02, 4]), pose=pose([0, reach[1] + 0.3, 0]))
    scene = scene_of(arm, objects=[wall])
    assert not scene.inCollision(q, 0.05)
    spec = vd.StopSupervisorSpec(period=0.01, margin=0.02)
    spec.validate()
    supervisor = vd.StopSupervisor(scene, spec)
    supervisor.reset()
    for _ in range(600):
        now = vd.ArmKinematics(arm, q)
        wish = np.linalg.pinv(now.geometric()[:3], rcond=0.05) @ [0, 0.3, 0]
        output = supervisor.step(q, wish)
        stopped |= output.status in (vd.Supervision.Slowed, vd.Supervision.Stopping, vd.Supervision.Standing)
        q = q + 0.01 * output.velocity
        assert not scene.inCollision(q, 0.02 - 1e-6), output.message()
    assert stopped


def servo_of(arm, **fields):
    spec = vd.VisualServoSpec(period=0.01, **fields)
    spec.validate()
    return vd.VisualServo("ff-lookat-pi", vd.ServoControllerSpec(), spec, arm)


def test_servo_of_an_arm_converges(arm):
    servo = servo_of(arm)
    q = np.clip(arm.home(), arm.lower() + 0.2, arm.upper() - 0.2)
    fMo = vd.ArmKinematics(arm, q).camera @ pose([0, 0, 0.4])
    cdMo = pose([0, 0, 0.38], [0, 0, 0.1])
    poses = {}  # of the object in the camera, by the time of the image

    def source(image):
        return poses[int(image[0, 0])], vd.PoseCovariance(known=True, C=1e-10 * np.eye(6))

    servo.setPoseSource(source, plate())
    servo.setGoal(servo.goal(cdMo))
    servo.supervise(scene_of(arm))
    assert servo.step(q, 0.0).status == vd.VisualServoStatus.Idle
    servo.start()
    for k in range(1, 1500):
        t = 0.01 * k
        camera = vd.ArmKinematics(arm, q).camera
        if k % 3 == 0:  # a camera of 33 Hz whose results are late by a period
            poses[k % 256] = np.linalg.inv(before) @ fMo
            sight = servo.see(np.full((4, 4), k % 256, np.uint8), t - 0.01)
            assert sight.measurement.valid and servo.cameraAt(t - 0.01) is not None
        output = servo.step(vd.ServoRobotState(q=q), t) if k % 2 else servo.step(q, t)
        before, q = camera, q + 0.01 * output.velocity
        if servo.isConverged():
            break
    assert output.status == vd.VisualServoStatus.Converged and output.message, output
    np.testing.assert_allclose(np.linalg.inv(vd.ArmKinematics(arm, q).camera) @ fMo, cdMo, atol=2e-3)
    assert servo.output().positionError < 0.002 and servo.measurement().valid and servo.spec().period == 0.01
    timing = servo.timing()
    assert timing.period.count() > 100 and timing.period.quantile(0.5) == pytest.approx(0.01, rel=0.05)
    assert timing.step.invalid() == 0 and timing.step.max() >= timing.step.quantile(0.9) > 0
    servo.stop()
    assert servo.step(q, t + 0.01).status == vd.VisualServoStatus.Idle
    with pytest.raises(ValueError, match="imageTimeout"):
        vd.VisualServoSpec(imageTimeout=-1).validate()


def test_servo_without_an_arm_takes_sights_and_laws_of_ones_own():
    class Broken(vd.ServoLaw):
        def __init__(self, gains):
            vd.ServoLaw.__init__(self, "broken", gains)

        def compute(self, measurement, dt):
            raise RuntimeError("nobody knows")

    from test_servo import Straight, moved

    for id, law in (("straight-servo", Straight), ("broken-servo", Broken)):
        vd.ServoLaw.add(id, "For this test.", law)
        servo = vd.VisualServo(id, spec=vd.VisualServoSpec(assumeExecuted=True, period=0.01, startTime=0))
        cdMo, cMo = pose([0, 0, 0.4]), pose([0.02, 0, 0.45])
        servo.setGoal(plate().goal(cdMo))
        servo.start()
        for k in range(1, 1200):
            if k > 1:
                servo.take(vd.ServoSight(measurement=plate().measure(cMo, 0.01 * (k - 1))))
            if id == "broken-servo" and k > 1:
                with pytest.raises(RuntimeError, match="nobody knows"):
                    servo.step(vd.ServoRobotState(), 0.01 * k)
                break
            output = servo.step(vd.ServoRobotState(), 0.01 * k)
            cMo = moved(cMo, output.twist, 0.01)
        else:
            np.testing.assert_allclose(cMo, cdMo, atol=2e-3)
    with pytest.raises(RuntimeError, match="vision"):
        servo.see(np.zeros((4, 4), np.uint8), 1.0)
    with pytest.raises(ValueError, match="unknown|nothing"):
        vd.VisualServo("nothing")


def test_servo_with_a_photograph(random):
    from test_vision import CAMERA, rendered, texture

    photo = texture(random)
    servo = vd.VisualServo("pbvs1", spec=vd.VisualServoSpec(assumeExecuted=True))
    servo.setPhotograph(photo, 0.16, 0.12, CAMERA)
    cMo = pose([0.01, 0, 0.3], [0.1, -0.2, 0])
    sight = servo.see(rendered(photo, 0.16, 0.12, cMo, random), 0.5)
    assert sight.measurement.valid
    np.testing.assert_allclose(sight.measurement.cMo[:3, 3], cMo[:3, 3], atol=1e-3)
    assert " " in servo.visionMessage()


def test_servo_with_one_reference_image(random):
    from test_vision import CAMERA, rendered, texture

    photo, cdMo = texture(random), pose([0, 0, 0.3], [0, 0, 0])
    teacher = vd.ReferenceTeacher(images=3)
    with pytest.raises(RuntimeError):
        teacher.image()
    while not teacher.isComplete():
        assert teacher.add(rendered(photo, 0.16, 0.12, cdMo, random)), teacher.message()
    assert " " in teacher.message() and 0 < teacher.averageNoise() < teacher.pointNoise() < 1
    servo = vd.VisualServo("ff-lookat", spec=vd.VisualServoSpec(assumeExecuted=True))
    servo.setReference(teacher.image(), CAMERA, vd.ReferenceVisionSpec(pose=vd.ReferencePoseSpec(nearest=0.2, farthest=1.0)))
    for k, cMo in enumerate((cdMo, pose([0.01, 0, 0.32], [0.1, -0.2, 0.3]))):
        sight = servo.see(rendered(photo, 0.16, 0.12, cMo, random), 0.1 * k)
        assert sight.measurement.valid and sight.hasGoal, servo.visionMessage()
        cdMc = sight.goal.cdMo @ np.linalg.inv(sight.measurement.cMo)  # its translation is known up to the scale
        np.testing.assert_allclose(cdMc[:3, :3], (cdMo @ np.linalg.inv(cMo))[:3, :3], atol=5e-3)


def test_servo_with_a_tag(random):
    from test_vision import CAMERA, texture

    servo = vd.VisualServo("pbvs1", spec=vd.VisualServoSpec(assumeExecuted=True))
    with pytest.raises(ValueError, match="36h12"):
        servo.setTag("36h12", 3, 0.05, CAMERA)
    servo.setTag("36h11", 3, 0.05, CAMERA)
    assert not servo.see(texture(random, 480, 640), 0.1).measurement.valid and "tag" in servo.visionMessage().lower()


def test_covers_and_exact_shapes():
    arm = vd.loadArmUrdf(str(DATA / "robot/generic-6r.urdf"), vd.ArmUrdfSpec(tip="tool", acceleration=5.0))
    cover = vd.coverArm(arm, vd.ArmCoverSpec(capsules=2))
    assert len(cover.arm.spec().capsules) >= len(arm.spec().capsules) and isinstance(cover.warnings, tuple)
    shapes = vd.ExactShapes(cover.arm)
    assert isinstance(shapes.has(0), bool) and isinstance(shapes.warnings(), list)
    spec = vd.CollisionSceneSpec(exact=shapes)
    del shapes
    assert spec.exact is not None and vd.CollisionScene(cover.arm, spec).capsuleCount() > 0
