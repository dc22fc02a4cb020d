# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Joint control, drives and simulated robots: against closed forms, the arm's own kinematics and dynamics, and in a servo loop."""
import threading
import time

import numpy as np
import pytest
import visp_direct as vd
from conftest import longer, pose, rotation

CAMERA_FRAME, JOINT_STATE, TOOL = vd.Robot.CAMERA_FRAME, vd.Robot.JOINT_STATE, vd.Robot.END_EFFECTOR_FRAME


def test_joint_control_is_its_formula(random):
    for _ in range(longer(20)):
        n = random.integers(1, 8)
        kp, kd, most, friction = random.uniform(0.1, 9, (4, n))
        joints = vd.JointFriction(viscous=friction, coulomb=0.5 * friction, smoothing=0.1)
        joints.validate(n)
        q, v, wq, wv, g = random.uniform(-1, 1, (5, n))
        wanted = friction * wv + 0.5 * friction * np.tanh(wv / 0.1)
        np.testing.assert_allclose(joints.torque(wv), wanted)
        spec = vd.JointPositionControlSpec(kp=kp, kd=kd, maxTorque=most, compensateFriction=True, friction=joints)
        spec.validate()
        given = vd.JointPositionControlInput(q=q, velocity=v, wantedQ=wq, wantedVelocity=wv, feedforward=g)
        output, free = vd.JointPositionControl(spec).step(given), wanted + kp * (wq - q) + kd * (wv - v) + g
        np.testing.assert_allclose(output.torque, np.clip(free, -most, most))
        assert output.valid and output.saturated == sum(1 << i for i in range(n) if abs(free[i]) > most[i])
        spec = vd.JointVelocityControlSpec(period=0.01, kp=kp, ki=kd, maxTorque=np.full(n, np.inf))
        spec.validate()
        control, error = vd.JointVelocityControl(spec), wv - v
        for k in range(1, 4):
            output = control.step(vd.JointVelocityControlInput(velocity=v, wantedVelocity=wv, feedforward=g))
            np.testing.assert_allclose(output.torque, kp * error + kd * k * 0.01 * error + g)
        np.testing.assert_allclose(control.integral(), 0.03 * error)
        control.reset()
        assert not control.integral().any() and not control.step(vd.JointVelocityControlInput(velocity=[np.nan])).valid
        estimator = vd.JointVelocityEstimator(n, 0.01, 50)
        for k in range(200):
            estimated = estimator.step(q + k * 0.01 * v)
        np.testing.assert_allclose(estimated, v, atol=1e-9)
        np.testing.assert_allclose(estimator.position(), q + 1.99 * v, atol=1e-9)
        assert estimator.measured()
        np.testing.assert_allclose(estimator.step(np.full(n, np.nan)), v, atol=1e-9)
        assert not estimator.measured()
        estimator.reset()
        assert not estimator.velocity().any()
    for bad, sentence in ((np.full(n, np.nan), "not finite"), (np.zeros(n + 1), "viscous of the joint friction has")):
        with pytest.raises(ValueError, match=sentence):
            joints.torque(bad)
    with pytest.raises(ValueError, match="maxTorque"):
        vd.JointPositionControl(vd.JointPositionControlSpec(kp=[1], kd=[1], maxTorque=[np.nan]))


def test_plant_moves_as_the_dynamics_say(arm, random):
    plant, dynamics = vd.ArmPlant(arm, 0), vd.ArmDynamics(arm)
    np.testing.assert_array_equal(plant.friction().viscous, 0)
    np.testing.assert_array_equal(vd.JointFriction.of(arm).coulomb, vd.ArmPlant(arm).friction().coulomb)
    for _ in range(longer(10)):
        q, torque = arm.home() + random.uniform(-0.1, 0.1, 7), random.uniform(-5, 5, 7)
        plant.reset(q)
        assert plant.step(torque, 1e-4)
        a = dynamics.acceleration(q, np.zeros(7), torque)
        np.testing.assert_allclose(plant.velocity(), 1e-4 * a, rtol=1e-6, atol=1e-9)
        np.testing.assert_allclose(plant.q(), q + 1e-8 * a, atol=1e-12)
    before = plant.q()
    for wrong, dt in ((np.zeros(3), 0.001), (np.full(7, np.nan), 0.001), (torque, 0), (torque, np.nan)):
        assert not plant.step(wrong, dt)
    np.testing.assert_array_equal(plant.q(), before)
    with pytest.raises(ValueError, match="has 3 numbers, must have 7"):
        plant.reset([0, 0, 0])
    with pytest.raises(ValueError, match="frictionScale"):
        vd.ArmPlant(arm, np.nan)


def test_drives_follow_their_commands(arm, random):
    spec = vd.ArmDriveSpec(reference=vd.DriveReference.Integrated)
    spec.validate(arm)
    ideal, drives = vd.ArmDrives(arm, vd.ArmDriveSpec(ideal=True)), vd.ArmDrives(arm, spec)
    assert drives.spec().period == 0.001
    for _ in range(longer(3)):
        v = random.uniform(-0.2, 0.2, 7)
        for made in (ideal, drives):
            made.reset(arm.home())
            for _ in range(100):
                assert made.move(v, 0.005)
            np.testing.assert_allclose(made.wanted(), arm.home() + 0.5 * v)
            np.testing.assert_array_equal(made.command(), v)
        np.testing.assert_array_equal(ideal.q(), ideal.wanted())
        np.testing.assert_allclose(drives.q(), drives.wanted(), atol=0.02)
        np.testing.assert_allclose(drives.velocity(), v, atol=0.05)
        np.testing.assert_array_equal(drives.measured(), drives.q())
        assert drives.torque().any() and drives.needed().any() and drives.saturated() == 0
    drives.holdHere()
    drives.setReference(vd.DriveReference.Measured)
    np.testing.assert_array_equal(drives.wanted(), drives.measured())
    assert drives.spec().reference == vd.DriveReference.Measured and not drives.command().any()
    for v, duration in ((np.zeros(3), 0.1), (np.full(7, np.nan), 0.1), (np.zeros(7), -1)):
        assert not drives.move(v, duration)
    lacks = vd.JointShortfall(joint=0, needed=26, given=12)
    assert lacks.missing() == 14 and "14 Nm are missing" in lacks.message(arm)
    with pytest.raises(ValueError, match="kp of the arm's drives has 2 numbers"):
        vd.ArmDrives(arm, vd.ArmDriveSpec(kp=[1, 2]))


def exponential(twist, t):
    """The motion of a constant twist: many small steps."""
    step = pose(np.asarray(twist[:3]) * t / 4096, np.asarray(twist[3:]) * t / 4096)
    return np.linalg.matrix_power(step, 4096)


def test_a_camera_moves_as_its_plant(random):
    for _ in range(longer(5)):
        plant = vd.ServoPlant(loopRate=50, visionRate=50, lag=0.05, deadband=0.1)
        plant.validate()
        robot, v, start = vd.FrictionCamera(plant), random.uniform(-0.5, 0.5, 6), pose(random.uniform(-1, 1, 3), random.uniform(-1, 1, 3))
        robot.setPosition(start)
        assert robot.getSamplingTime() == pytest.approx(0.02)
        robot.setVelocity(CAMERA_FRAME, v)
        assert robot.getRobotState() == vd.Robot.STATE_VELOCITY_CONTROL
        moved = v * (1 - np.exp(-0.02 / 0.05))
        moved[3:] = np.sign(moved[3:]) * np.maximum(abs(moved[3:]) - 0.1, 0)
        np.testing.assert_allclose(robot.actualTwist(), moved, atol=1e-6)
        np.testing.assert_allclose(robot.getPosition(), start @ exponential(moved, robot.getSamplingTime()), atol=1e-6)
        robot.setRobotState(vd.Robot.STATE_STOP)
        assert not robot.actualTwist().any()
    robot = vd.FrictionCamera(vd.ServoPlant.byName("A"))
    robot.setMaxTranslationVelocity(0.3)
    robot.setMaxRotationVelocity(0.4)
    assert (robot.getMaxTranslationVelocity(), robot.getMaxRotationVelocity()) == (0.3, 0.4)
    robot.setVelocity(CAMERA_FRAME, [5, 0, 0, 0, 0, 0])
    assert robot.actualTwist()[0] == pytest.approx(0.3)
    with pytest.raises(RuntimeError, match="camera frame only"):
        robot.setVelocity(vd.Robot.REFERENCE_FRAME, np.zeros(6))
    for bad in (np.zeros(5), [np.nan] * 6):
        with pytest.raises(ValueError):
            robot.setVelocity(CAMERA_FRAME, bad)
    for setter in (robot.setMaxRotationVelocity, robot.setMaxTranslationVelocity, robot.setSamplingTime):
        with pytest.raises(ValueError, match="must be > 0 and finite"):
            setter(np.nan)
    with pytest.raises(ValueError, match="A, B"):
        vd.ServoPlant.byName("Z")


def test_simulated_arm_is_a_robot(arm, random):
    spec = vd.SimulatedArmSpec(start=arm.home(), drives=vd.ArmDriveSpec(ideal=True))
    spec.validate(arm)
    robot = vd.SimulatedArm(arm, spec)
    assert robot.getModel().label() == arm.label() and isinstance(robot, vd.Robot)
    robot.setPositioningVelocity(50)
    for _ in range(longer(5)):
        goal = arm.home() + random.uniform(-0.2, 0.2, 7)
        robot.setPosition(JOINT_STATE, goal)
        np.testing.assert_allclose(robot.getPosition(JOINT_STATE), goal, atol=1e-6)
        here = vd.ArmKinematics(arm, robot.getPosition(JOINT_STATE))
        np.testing.assert_allclose(robot.get_fMe(), here.tool, atol=1e-9)
        np.testing.assert_allclose(robot.get_fMc(), here.camera, atol=1e-9)
        np.testing.assert_allclose(robot.get_cMe(), np.linalg.inv(here.camera) @ here.tool, atol=1e-9)
        np.testing.assert_allclose(robot.get_eJe(), here.geometric(vd.ArmFrame.EndEffector), atol=1e-9)
        np.testing.assert_allclose(robot.get_fJe(), here.geometric(), atol=1e-9)
        cJ = robot.get_cVe() @ robot.get_eJe()
        np.testing.assert_allclose(cJ, here.geometric(vd.ArmFrame.Camera), atol=1e-9)
        p = robot.getPosition(TOOL)
        np.testing.assert_allclose(pose(p[:3], p[3:]), here.tool, atol=1e-9)
        np.testing.assert_allclose(rotation(p[3:]), here.tool[:3, :3], atol=1e-9)
    robot.setRobotState(vd.Robot.STATE_VELOCITY_CONTROL)
    robot.setSamplingTime(0.04)
    robot.getDisplacement(CAMERA_FRAME)
    v, before, start = [0.01, 0.02, -0.01, 0.02, 0, 0.03], robot.get_fMc(), robot.getState().time
    for _ in range(25):
        robot.setVelocity(CAMERA_FRAME, v)
    state = robot.getState()
    assert state.time == pytest.approx(start + 1) and state.status == vd.SimulatedArmStatus.Moving and robot.getSentence()
    np.testing.assert_allclose(robot.getVelocity(CAMERA_FRAME), v, atol=1e-4)
    moved = np.linalg.inv(before) @ robot.get_fMc()
    np.testing.assert_allclose(moved, exponential(v, 1), atol=2e-3)
    d = robot.getDisplacement(CAMERA_FRAME)
    np.testing.assert_allclose(pose(d[:3], d[3:]), moved, atol=1e-9)
    robot.wait(1)
    assert robot.getState().status in (vd.SimulatedArmStatus.Stale, vd.SimulatedArmStatus.Stopped)
    robot.setSelfMotion([vd.SelfMotionIndex.manipulability()], [False] * 5 + [True])
    robot.setRobotState(vd.Robot.STATE_STOP)
    assert robot.getRobotState() == vd.Robot.STATE_STOP and np.abs(robot.getState().velocity).max() < 1e-3


def test_errors_of_a_simulated_arm_are_sentences(arm):
    robot = vd.SimulatedArm(arm)
    with pytest.raises(RuntimeError, match="not in velocity control"):
        robot.setVelocity(CAMERA_FRAME, np.zeros(6))
    robot.setRobotState(vd.Robot.STATE_VELOCITY_CONTROL)
    for wrong, sentence in ((np.zeros(3), "7"), (np.full(7, np.nan), "nan"), (np.zeros((7, 1)), "shape")):
        with pytest.raises(ValueError, match=sentence):
            robot.setVelocity(JOINT_STATE, wrong)
    with pytest.raises(ValueError, match="joint"):
        robot.setPosition(JOINT_STATE, np.full(7, 50))
    with pytest.raises(RuntimeError, match="workspace|closer|reach|singular"):
        robot.setPosition(TOOL, [9, 0, 0, 0, 0, 0])
    with pytest.raises(RuntimeError, match="frame"):
        robot.getPosition(vd.Robot.MIXT_FRAME)
    for call in (lambda: robot.wait(-1), lambda: robot.setSamplingTime(0), lambda: robot.setPositioningVelocity(0)):
        with pytest.raises(ValueError):
            call()
    with pytest.raises(ValueError, match="watchdog"):
        vd.SimulatedArm(arm, vd.SimulatedArmSpec(watchdog=-1))
    with pytest.raises(TypeError):
        vd.ControlFrameType(3)


def test_other_threads_run_while_the_arm_moves(arm):
    robot, count, done = vd.SimulatedArm(arm, vd.SimulatedArmSpec(clock=vd.ArmClock.RealTime)), [0], threading.Event()

    def work():
        while not done.is_set():
            count[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=work)
    thread.start()
    robot.wait(0.3)
    worked = count[0]
    done.set()
    thread.join()
    assert worked > 10 and robot.getState().time >= 0.25


def test_stage_moves_as_newton_says(random):
    for _ in range(longer(20)):
        mass, force, T = random.uniform(0.5, 2), random.uniform(-1, 1, 2), random.uniform(0.5, 5)
        axis = vd.XYStageAxis(mass=mass)
        stage = vd.XYStage(vd.XYStageSpec(x=axis, y=axis))
        stage.reset([1, 2])
        state = stage.step(T, force)
        np.testing.assert_allclose(state.position, [1, 2] + force * T * T / 2 / mass, atol=1e-9)
        np.testing.assert_allclose(stage.state().velocity, force * T / mass, atol=1e-9)
        assert state.time == T and state.resting == (False, False) and stage.spec().x.mass == mass
    spec = vd.XYStageSpec.thesis()
    spec.validate()
    stage = vd.XYStage(spec)
    assert stage.step(1, [0.1, 0]).resting[0]  # below its stiction
    for _ in range(2000):
        state = stage.step(1, [0.2, 0])
    assert spec.x.friction(state.velocity[0], state.position[0]) == pytest.approx(0.2, rel=1e-3)
    stage.reset()
    assert stage.state().time == 0
    for dt, command in ((np.nan, [0, 0]), (1, [np.nan, 0]), (1, [0, 0, 0])):
        with pytest.raises(ValueError):
            stage.step(dt, command)
    with pytest.raises(ValueError, match="mass"):
        vd.XYStage(vd.XYStageSpec(x=vd.XYStageAxis(mass=-1)))


def test_a_servo_loop_in_simulation(random):
    """A law, a vision system at 10 Hz with latency, and a camera with lag: arrives."""
    target, plant = vd.ServoTarget.rectangle(0.16, 0.12), vd.ServoPlant(loopRate=100, visionRate=10, latency=0.1, lag=0.03)
    goal = pose([0, 0, 0.4])
    for _ in range(longer(3)):
        law, robot, vision = vd.ServoLaw.create("pbvs1"), vd.FrictionCamera(plant), vd.VisionChannel(plant.visionRate, plant.latency)
        law.setGoal(target.goal(goal))
        robot.setPosition(pose(random.uniform(-0.1, 0.1, 3) - [0, 0, 0.6], random.uniform(-0.2, 0.2, 3)))
        seen, delays = None, set()
        for k in range(1500):
            now = k / plant.loopRate
            if vision.due(now):
                vision.push(target.measure(np.linalg.inv(robot.getPosition()), now))
            arrived = vision.pop(now)
            if arrived is not None:
                seen = arrived
                delays.add(round(now - arrived.time, 6))
            if seen is not None:
                robot.setVelocity(CAMERA_FRAME, law.step(seen, 1 / plant.loopRate).v)
        np.testing.assert_allclose(np.linalg.inv(robot.getPosition()), goal, atol=2e-3)
        assert delays == {0.1}
    with pytest.raises(ValueError, match="not finite"):
        vision.push(vd.ServoMeasurement(time=np.nan))
    with pytest.raises(ValueError, match="frame rate"):
        vd.VisionChannel(np.nan, 0)
