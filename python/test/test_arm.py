# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Arms against finite differences and the tables of their joints, computed by numpy."""
import numpy as np
import pytest
import visp_direct as vd
from conftest import DATA, longer, pose


def configuration(random, arm):
    return random.uniform(np.maximum(arm.lower(), -3), np.minimum(arm.upper(), 3))


def forward(arm, q):
    """fMe from the joints of the specification."""
    M = np.eye(4)
    for joint, angle in zip(arm.spec().joints, q):
        value = angle + joint.offset
        motion = pose([0, 0, value]) if joint.type == vd.JointType.Prismatic else pose([0, 0, 0], [0, 0, value])
        M = M @ joint.before @ motion @ joint.after
    return M @ arm.spec().tool


def differences(function, q, h=1e-6):
    return np.stack([(function(q + h * e) - function(q - h * e)) / (2 * h) for e in np.eye(len(q))], axis=-1)


def test_kinematics(arm, random):
    for _ in range(longer(50)):
        q = configuration(random, arm)
        now = vd.ArmKinematics(arm, q)
        np.testing.assert_array_equal(now.q, q)
        np.testing.assert_allclose(now.tool, forward(arm, q), atol=1e-12)
        np.testing.assert_allclose(now.camera, now.tool @ arm.spec().camera, atol=1e-12)
        np.testing.assert_allclose(now.link(arm.size()) @ arm.spec().tool, now.tool, atol=1e-12)
        J = now.geometric(vd.ArmFrame.Base)
        np.testing.assert_allclose(J[:3], differences(lambda x: forward(arm, x)[:3, 3], q), atol=1e-8)
        R = now.tool[:3, :3]
        turned = np.einsum("ijk,lj->ilk", differences(lambda x: forward(arm, x)[:3, :3], q), R)
        np.testing.assert_allclose(J[3:], [turned[2, 1], turned[0, 2], turned[1, 0]], atol=1e-8)
        np.testing.assert_allclose(now.geometric(vd.ArmFrame.EndEffector)[:3], R.T @ J[:3], atol=1e-12)
        np.testing.assert_allclose(now.pointJacobian(arm.size()), J[:3], atol=1e-12)
        assert now.joint(0).shape == (4, 4) and now.analytic().shape == J.shape
        jacobian = lambda x: vd.ArmKinematics(arm, x).geometric()
        dJ = differences(jacobian, q)
        np.testing.assert_allclose(now.derivative(2), dJ[..., 2], atol=1e-7)
        velocity = random.uniform(-1, 1, arm.size())
        np.testing.assert_allclose(now.timeDerivative(velocity), dJ @ velocity, atol=1e-6)


def test_indices_have_exact_gradients(arm, random):
    indices = [
        vd.SelfMotionIndex.manipulability(),
        vd.SelfMotionIndex.weightedManipulability(np.full(arm.size(), 2.0), 0.5),
        vd.SelfMotionIndex.pointDistance(3, [0.2, 0.3, 0.4], vd.IndexSense.Repel),
        vd.SelfMotionIndex.lineDistance(3, vd.IndexSense.Attract),
        vd.SelfMotionIndex.planeDistance(3, [0, 0, 0.1], [0, 0, 1], vd.IndexSense.Repel),
        vd.SelfMotionIndex.jointLimits(),
        vd.SelfMotionIndex.posture(arm.home()),
    ]
    for _ in range(longer(10)):
        q = configuration(random, arm)
        for index in indices:
            value = vd.ArmKinematics(arm, q).evaluate(index)
            numeric = differences(lambda x: np.array(vd.ArmKinematics(arm, x).evaluate(index).value), q)
            np.testing.assert_allclose(value.gradient, numeric, atol=1e-5, err_msg=str(index.kind))
    with pytest.raises(ValueError, match="joint"):
        vd.SelfMotionIndex.pointDistance(9, [0, 0, 0], vd.IndexSense.Repel).validate(arm)


def test_redundancy_gives_the_twist_within_limits(arm, random):
    spec = vd.RedundancySpec(period=0.01)
    spec.validate(arm)
    solver = vd.RedundancySolver(arm, spec)
    assert solver.spec().period == 0.01
    exact = 0
    for _ in range(longer(50)):
        now = vd.ArmKinematics(arm, 0.8 * configuration(random, arm))
        given = vd.RedundancyInput(
            twist=random.uniform(-0.01, 0.01, 6), frame=vd.ArmFrame.Base, previous=np.zeros(arm.size())
        )
        given.indices = [vd.SelfMotionIndex.jointLimits()]
        given.tasks = [vd.ArmTask.pointVelocity(now, 3, [0.01, 0, 0])]
        assert given.indexCount == given.taskCount == 1 and len(given.indices) == 1
        for _ in range(200):  # the acceleration limits need some periods
            output = solver.step(now, given)
            given.previous = output.velocity
        assert (np.abs(output.velocity) <= arm.velocity() * (1 + 1e-9)).all()
        if output.status == vd.RedundancyStatus.Exact:
            exact += 1
            np.testing.assert_allclose(now.geometric() @ output.velocity, given.twist, atol=1e-7)
        assert isinstance(output.message(), str)
    assert exact > longer(50) / 5
    with pytest.raises(ValueError, match="9 indices were given, must be at most 8"):
        given.indices = [vd.SelfMotionIndex()] * 9
    with pytest.raises(ValueError, match="period"):
        vd.RedundancySpec(period=-1).validate(arm)


def test_motion_reaches_a_configuration_and_a_pose(arm, random):
    motion = vd.ArmMotion(arm, vd.RedundancySpec(period=0.01), vd.ClosedLoopSpec())
    q, velocity = arm.home(), np.zeros(arm.size())
    goal = q + random.uniform(-0.2, 0.2, arm.size())
    goal = np.clip(goal, arm.lower() + 0.01, arm.upper() - 0.01)
    motion.jointPath(goal, q, velocity, 0.5)
    for _ in range(2000):
        if motion.kind() == vd.ArmTaskKind.Hold:
            break
        velocity = motion.step(q, velocity)
        assert (np.abs(velocity) <= arm.velocity() * (1 + 1e-9)).all()
        q = q + motion.period() * velocity
    assert motion.finished() and not motion.failed() and motion.pathSentence()
    np.testing.assert_allclose(q, goal, atol=1e-6)
    there = forward(arm, np.clip(goal + 0.1, arm.lower() + 0.01, arm.upper() - 0.01))
    motion.setSelfMotion([vd.SelfMotionIndex.jointLimits()], [False] * 6)
    motion.posePath(there, q, velocity)
    for _ in range(2000):
        velocity = motion.step(q, velocity)
        q = q + motion.period() * velocity
    assert motion.poseStatus() == vd.ClosedLoopStatus.Reached
    np.testing.assert_allclose(forward(arm, q), there, atol=1e-4)
    motion.twist([0, 0, 0.02, 0, 0, 0], vd.ArmTwistFrame.Base)
    motion.step(q, velocity)
    assert isinstance(motion.solver().status, vd.RedundancyStatus)
    motion.jointVelocity(np.full(arm.size(), 0.01))
    motion.hold()
    for _ in range(100):
        velocity = motion.step(q, velocity)
    np.testing.assert_allclose(velocity, 0, atol=1e-12)
    with pytest.raises(ValueError, match="q has 3 numbers, the arm has 7 joints"):
        motion.step(np.zeros(3), velocity)


def test_models_from_files_and_tables():
    urdf = vd.loadArmUrdf(str(DATA / "robot/generic-6r.urdf"), vd.ArmUrdfSpec(tip="tool", acceleration=5.0))
    assert urdf.size() == 6 and isinstance(urdf.hasMasses(), bool) and (urdf.acceleration() <= 5).all()
    urdf.requireMotionLimits("this test")
    assert (
        not urdf.isPrismatic(0) and isinstance(urdf.isContinuous(0), bool) and len(urdf.torque()) == 6 and urdf.label()
    )
    assert urdf.outsideLimits(urdf.home()) == "" and "outside" in urdf.outsideLimits(np.full(6, 100.0))
    joints = [vd.ArmJointSpec.standardDH(0.4, 0, 0, 0), vd.ArmJointSpec.modifiedDH(0.4, 0, 0, 0)]
    for i, joint in enumerate(joints):
        joint.name, joint.lower, joint.upper = f"joint {i}", -1, 1
    plane = vd.ArmModel(vd.ArmSpec(name="plane", joints=joints, home=[0.1, 0.2]))
    np.testing.assert_allclose(vd.ArmKinematics(plane, [0, 0]).tool[:3, 3], [0.8, 0, 0], atol=1e-12)
    np.testing.assert_array_equal(plane.home(), [0.1, 0.2])
    with pytest.raises(ValueError, match="velocity"):
        plane.requireMotionLimits("this test")
    with pytest.raises(OSError, match="nowhere.json"):
        vd.loadArmJson("nowhere.json")
    with pytest.raises(ValueError, match="joint"):
        vd.ArmModel(vd.ArmSpec(name="empty"))
    with pytest.raises(IndexError, match="joint 2 does not exist, there are 2"):
        plane.isPrismatic(2)
    with pytest.raises(ValueError, match="q has 3 numbers, the arm has 2 joints"):
        vd.ArmKinematics(plane, [0, 0, 0])
    with pytest.raises(ValueError, match="not finite"):
        vd.ArmKinematics(plane, [0, np.nan])
    with pytest.raises(ValueError, match="has more than 16 numbers"):
        vd.ArmKinematics(plane, np.zeros(17))
    with pytest.raises(ValueError, match="gain"):
        vd.ClosedLoopSpec(gain=-1).validate(0.01)


def test_followers_move_with_their_joint(random):
    joint = vd.ArmJointSpec.standardDH(0.3, 0, 0, 0)
    joint.name, joint.lower, joint.upper = "crank", -2, 2
    follower = vd.ArmFollower(name="rod", after=pose([0.2, 0, 0]), joint=0, ratio=-0.5, offset=0.1, place=1)
    arm = vd.ArmModel(vd.ArmSpec(name="linkage", joints=[joint], followers=[follower]))
    assert (arm.size(), arm.links(), arm.toolLink(), arm.cameraLink()) == (1, 2, 2, 2)
    part = arm.chain(1)
    assert (part.joint, part.ratio, part.offset, part.isPrismatic) == (0, -0.5, 0.1, False)
    for _ in range(longer(20)):
        q = random.uniform(-2, 2)
        second = q - 0.5 * q + 0.1
        tool = vd.ArmKinematics(arm, [q]).tool
        np.testing.assert_allclose(
            tool[:2, 3], [0.3 * np.cos(q) + 0.2 * np.cos(second), 0.3 * np.sin(q) + 0.2 * np.sin(second)], atol=1e-12
        )
    with pytest.raises(IndexError, match="joint of the chain 2 does not exist, there are 2"):
        arm.chain(2)


def test_axes_by_name():
    assert vd.freeAxes(["rz"]) == [False] * 5 + [True]
    assert vd.axesInWords(32) == "rotation about z"
    with pytest.raises(ValueError, match="w"):
        vd.freeAxes(["w"])


def test_an_arm_lives_as_long_as_it_is_used(random):
    def kinematics():
        return vd.ArmKinematics(vd.loadArmJson(str(DATA / "robot/amor.json")), np.zeros(7))

    kept = [kinematics() for _ in range(50)]
    reference = kept[0].geometric()
    for now in kept:
        np.testing.assert_array_equal(now.geometric(), reference)


def test_dynamics_hold_together(arm, random):
    """M is symmetric and positive definite, M' - 2 C skew, and the acceleration the solution of the equation of motion."""
    joint = vd.ArmJointSpec.standardDH(0.5, 0, 0, 0)
    joint.name, joint.lower, joint.upper = "hinge", -4, 4
    with pytest.raises(ValueError, match="mass"):
        vd.ArmDynamics(vd.ArmModel(vd.ArmSpec(name="without masses", joints=[joint])))
    dynamics, still = vd.ArmDynamics(arm), vd.ArmDynamics(arm, [0, 0, 0])
    for _ in range(longer(20)):
        q, v, torque = random.uniform(-1, 1, (3, arm.size()))
        M = dynamics.inertia(q)
        np.testing.assert_allclose(M, M.T, atol=1e-12)
        assert np.linalg.eigvalsh(M).min() > 0
        a = dynamics.acceleration(q, v, torque)
        np.testing.assert_allclose(M @ a + dynamics.coriolis(q, v) + dynamics.gravity(q), torque, atol=1e-9)
        np.testing.assert_allclose(still.gravity(q), 0, atol=1e-12)
        # M' - 2 C is skew: v' (M' v / 2 - C v) = 0.
        h = 1e-6
        rate = (dynamics.inertia(q + h * v) - dynamics.inertia(q - h * v)) / (2 * h)
        assert v @ (rate @ v / 2 - dynamics.coriolis(q, v)) == pytest.approx(0, abs=1e-6)
    for call in (dynamics.inertia, dynamics.gravity):
        for bad in (np.zeros(3), np.full(arm.size(), np.nan)):
            with pytest.raises(ValueError, match="the dynamics have no result"):
                call(bad)
    with pytest.raises(ValueError, match="the dynamics have no result"):
        dynamics.acceleration(q, v, np.full(arm.size(), np.inf))
