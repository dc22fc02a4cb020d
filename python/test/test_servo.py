# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Servo laws, also of one's own, in a loop with a camera that is moved by numpy."""
import numpy as np
import pytest
import visp_direct as vd
from conftest import longer, pose, rotation


LAWS = vd.ServoLaw.ids()  # before a test adds its own


def moved(cMo, twist, dt):
    """Pose of a static object after the camera has moved with a twist in its own frame: exp of se(3)."""
    v, w = twist[:3] * dt, twist[3:] * dt
    angle = np.linalg.norm(w)
    W = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    V = np.eye(3) + W / 2
    if angle > 1e-9:
        V = np.eye(3) + (1 - np.cos(angle)) / angle**2 * W + (angle - np.sin(angle)) / angle**3 * W @ W
    motion = np.eye(4)
    motion[:3, :3], motion[:3, 3] = rotation(w), V @ v
    return np.linalg.inv(motion) @ cMo


def angle_axis(R):
    angle = np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1))
    axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    return axis * (angle / (2 * np.sin(angle)) if angle > 1e-9 else 0.5)


class Straight(vd.ServoLaw):
    """A law of ten lines: the camera goes straight to the goal and turns about a fixed axis."""

    def __init__(self, gains=vd.ServoGains()):
        vd.ServoLaw.__init__(self, "straight", gains)

    def goalChanged(self):
        self.cdMo = self.goal().cdMo

    def compute(self, measurement, dt):
        cdMc = self.cdMo @ np.linalg.inv(measurement.cMo)
        R = cdMc[:3, :3]
        gain = self.gains().lambda_
        return np.concatenate([-gain * R.T @ cdMc[:3, 3], -gain * angle_axis(R)])


def plate():
    return vd.ServoTarget.rectangle(0.16, 0.11)


def drive(law, cMo, cdMo, seconds=12.0, dt=0.02):
    law.setGoal(plate().goal(cdMo))
    for k in range(int(seconds / dt)):
        command = law.step(plate().measure(cMo, k * dt), dt)
        if not vd.isWorking(command.status):
            return cMo, command
        cMo = moved(cMo, command.v, dt)
    return cMo, command


def start(random):
    return pose([*random.uniform(-0.1, 0.1, 2), random.uniform(0.4, 0.8)], random.uniform(-0.5, 0.5, 3))


def test_all_laws_arrive(random):
    goal = pose([0, 0, 0.4])
    for id in [*LAWS, "ff-lookat-pi+cbf"]:
        for _ in range(longer(3)):
            law = vd.ServoController.create(id)
            assert law.id() == id
            cMo, command = drive(law, start(random), goal, 30)
            assert vd.isWorking(command.status), (id, command.message())
            np.testing.assert_allclose(cMo, goal, atol=5e-3, err_msg=id)


def test_law_of_ones_own_is_the_law_of_the_library(random):
    own, library = Straight(), vd.ServoLaw.create("pbvs1")
    for law in (own, library):
        law.setGoal(plate().goal(pose([0, 0, 0.4])))
    for _ in range(longer(200)):
        seen = plate().measure(start(random))
        mine, theirs = own.step(seen, 0.02), library.step(seen, 0.02)
        assert mine.status == theirs.status == vd.ServoStatus.Servoing
        np.testing.assert_allclose(mine.v, theirs.v, atol=1e-9)
    cMo, _ = drive(own, start(random), pose([0, 0, 0.4]))
    np.testing.assert_allclose(cMo, pose([0, 0, 0.4]), atol=1e-4)


def test_exceptions_of_a_law_come_out_of_step(random):
    seen = plate().measure(start(random))

    class Broken(Straight):
        def compute(self, measurement, dt):
            raise RuntimeError("nobody knows")

    class NotFinite(Straight):
        def compute(self, measurement, dt):
            return np.full(6, np.nan)

    class Short(Straight):
        def compute(self, measurement, dt):
            return np.zeros(5)

    class Without(vd.ServoLaw):
        pass

    class BadGoal(Straight):
        def goalChanged(self):
            raise RuntimeError("no such goal")

    with pytest.raises(RuntimeError, match="no such goal"):
        BadGoal().setGoal(plate().goal(pose([0, 0, 0.4])))

    for law, error, sentence in (
        (Broken(), RuntimeError, "nobody knows"),
        (NotFinite(), ValueError, "straight .*not finite"),
        (Short(), ValueError, "must be 6 numbers"),
        (Without("none"), TypeError, "no method compute"),
    ):
        law.setGoal(plate().goal(pose([0, 0, 0.4])))
        for _ in range(2):
            with pytest.raises(error, match=sentence):
                law.step(seen, 0.02)


def test_laws_of_ones_own_by_name(random, seed):
    name, other = f"straight-{seed}", f"no-law-{seed}"  # what is added stays
    vd.ServoLaw.add(name, "Straight to the goal.", Straight)
    assert name in vd.ServoLaw.ids() and vd.ServoLaw.sentence(name) == "Straight to the goal."
    controller = vd.ServoController.create(f"{name}+cbf")
    controller.notifyInterrupted()
    cMo, command = drive(controller, pose([0.02, 0, 0.5]), pose([0, 0, 0.4]))
    np.testing.assert_allclose(cMo, pose([0, 0, 0.4]), atol=1e-3)
    law = vd.ServoLaw.create(name, vd.ServoGains(lambda_=2))
    own = Straight(vd.ServoGains(lambda_=2))
    for each in (law, own):
        each.setGoal(plate().goal(pose([0, 0, 0.4])))
    seen = plate().measure(start(random))
    np.testing.assert_array_equal(law.step(seen, 0.02).v, own.step(seen, 0.02).v)
    for id, maker, sentence in (
        (name, Straight, name),
        ("two words", Straight, "two words"),
    ):
        with pytest.raises(ValueError, match=sentence):
            vd.ServoLaw.add(id, "Again.", maker)
    vd.ServoLaw.add(other, "Makes something else.", lambda gains: 3)
    with pytest.raises(TypeError, match=f"the law {other} is an int, must be a ServoLaw"):
        vd.ServoLaw.create(other)


def test_a_law_keeps_its_state():
    class Counting(Straight):
        resets = 0

        def stateReset(self):
            self.resets += 1

    law = Counting(vd.ServoGains(lambda_=2))
    law.setGoal(plate().goal(pose([0, 0, 0.4])))
    law.reset()
    law.notifyInterrupted()
    assert law.resets == 1 and law.gains().lambda_ == 2 and law.rotationGain() == 2
    assert law.step(plate().measure(pose([0, 0, 1])), 0.02).status == vd.ServoStatus.NoGoal


def test_bad_arguments_have_a_sentence():
    with pytest.raises(ValueError, match="unknown|no law"):
        vd.ServoLaw.create("nothing")
    with pytest.raises(ValueError, match="lambda of the servo gains is -1"):
        vd.ServoLaw.create("pbvs1", vd.ServoGains(lambda_=-1))
    with pytest.raises(ValueError, match="lambda"):
        vd.ServoGains(lambda_=np.nan).validate()
    with pytest.raises(ValueError, match="points"):
        vd.ServoLaw.create("pbvs1").setGoal(vd.ServoGoal())
    with pytest.raises(ValueError, match="not finite"):
        plate().measure(np.full((4, 4), np.nan))
    for spec in (
        vd.ServoMotionLimits(linearJerk=-1),
        vd.ViewConstraintSpec(left=1),
        vd.TargetLossSpec(holdTime=-1),
        vd.ServoControllerSpec(recovery=vd.TargetLossSpec(holdTime=-1)),
    ):
        with pytest.raises(ValueError, match="must be"):
            spec.validate()


def test_controller_and_its_parts(random):
    camera = vd.CameraParameters(800, 800, 320, 240)
    spec = vd.ServoControllerSpec(view=vd.ViewConstraintSpec.fromCamera(camera, 640, 480))
    assert spec.view.left == pytest.approx(-0.4) and "pbvs1" in vd.ServoController.ids()
    controller = vd.ServoController.create("pbvs1", spec)
    assert controller.spec().view.left == spec.view.left
    goal = plate().goal(pose([0, 0, 0.4]))
    assert goal.mean().x == pytest.approx(0)
    controller.setGoal(goal)
    seen = plate().measure(start(random), 1.5)
    assert seen.valid and seen.time == 1.5 and len(seen.points) == 4
    command = controller.step(seen, 0.02)
    np.testing.assert_allclose(controller.referenceRotation(seen, command), np.eye(3), atol=1e-9)
    seen.valid = False
    assert controller.step(seen, 0.02).status == vd.ServoStatus.Holding
    controller.reset()
    view = vd.ViewConstraintFilter(spec.view)
    outline = [vd.ServoPoint(x=0.39, y=0, Z=0.5)]
    towards = vd.ServoCommand(
        v=[-1, 0, 0, 0, 0, 0], status=vd.ServoStatus.Servoing
    )  # the point would leave to the right
    filtered = view.filter(towards, outline, 0.01)
    v, x, Z = filtered.v, 0.39, 0.5
    assert filtered.status == vd.ServoStatus.ViewLimited
    assert (-v[0] + x * v[2]) / Z - (1 + x * x) * v[4] <= spec.view.gamma * (
        spec.view.right - x
    )  # its velocity in the image
    assert view.margin(0.5, 0.1, 0.1, 0.01) > 0


def test_recovery_undoes_the_motion():
    recovery = vd.TargetLossRecovery(vd.TargetLossSpec(holdTime=0.05))
    recovery.reset()
    forward = vd.ServoCommand(v=[0.1, 0, 0, 0, 0, 0], status=vd.ServoStatus.Servoing)
    for _ in range(10):
        assert recovery.step(forward, 0.02).status == vd.ServoStatus.Servoing
    lost = vd.ServoCommand(status=vd.ServoStatus.Holding)
    undone = sum(recovery.step(lost, 0.02).v[0] * 0.02 for _ in range(100))
    assert undone == pytest.approx(-10 * 0.1 * 0.02, rel=1e-9)


def test_odometry_predicts_a_late_measurement(random):
    for _ in range(longer(20)):
        bridge = vd.OdometryBridge(1, 100)
        cMo = start(random)
        seen = plate().measure(cMo, 0.0)
        twist = random.uniform(-0.1, 0.1, 6)
        for k in range(1, 21):
            assert bridge.move(twist, 0.01 * k)
        assert bridge.correct(seen)
        now = bridge.predict()
        assert now.valid and bridge.age() == pytest.approx(0.2)
        np.testing.assert_allclose(now.cMo, moved(cMo, twist, 0.2), atol=1e-9)


def test_target_points_and_measurement_of_an_image(random):
    points = random.uniform(-0.1, 0.1, (5, 3))
    target = vd.ServoTarget(points, points[:2])
    np.testing.assert_array_equal(target.points(), points)
    np.testing.assert_array_equal(target.outline(), points[:2])
    cMo = start(random)
    seen = target.measure(cMo)
    projected = (cMo @ np.c_[points, np.ones(5)].T)[:3]
    np.testing.assert_allclose(
        [[p.x, p.y, p.Z] for p in seen.points], projected.T / np.c_[projected[2], projected[2], np.ones(5)], atol=1e-12
    )
    assert not target.measure(vd.PlanarTargetResult()).valid
    with pytest.raises(ValueError, match="must be n x 3 numbers"):
        vd.ServoTarget(np.zeros((4, 2)))


def test_a_controller_that_is_passed_over_knows_where_the_camera_went(random):
    goal, dt = pose([0, 0, 0.4]), 0.01
    for id in ("dtg", "ff-dtg"):
        controller, cMo = vd.ServoController.create(id), start(random)
        controller.setGoal(plate().goal(goal))
        away = np.concatenate([random.uniform(-0.02, 0.02, 3), random.uniform(-0.05, 0.05, 3)])
        for k in range(3000):
            if 50 <= k < 100:  # something else moves the camera
                controller.pass_(dt)
                twist = away * np.sin(np.pi * (k - 50) / 50)
            else:
                seen = plate().measure(cMo, 1.0)  # one image: afterwards there is the odometry alone
                twist = controller.step(seen, dt).v
            controller.notifyExecuted(twist, twist)
            cMo = moved(cMo, twist, dt)
        np.testing.assert_allclose(cMo, goal, atol=8e-3, err_msg=id)
    with pytest.raises(TypeError):
        controller.pass_()
