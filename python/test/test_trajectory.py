# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Trajectories: limits by dense sampling of the polynomials, evaluated by numpy."""
import numpy as np
import pytest
import visp_direct as vd
from conftest import longer, pose


def random_problem(random, axes):
    problem = vd.TrajectoryInput(axes)
    problem.maxVelocity = random.uniform(0.2, 2, axes)
    problem.maxAcceleration = random.uniform(0.2, 4, axes)
    problem.start.q = random.uniform(-1, 1, axes)
    problem.start.v = random.uniform(-0.9, 0.9, axes) * problem.maxVelocity
    problem.goal.q = random.uniform(-1, 1, axes)
    return problem


def derivatives(coefficients, t):
    p = np.polynomial.Polynomial(coefficients)
    return np.stack([p(t), p.deriv(1)(t), p.deriv(2)(t), p.deriv(3)(t)])


def test_plan_keeps_limits_and_arrives(random):
    for _ in range(longer(200)):
        axes = int(random.integers(1, 8))
        problem = random_problem(random, axes)
        status, plan = vd.DirectTrajectory.calculate(problem)
        assert status.result == vd.TrajectoryResult.Working and status.isGood(), status.message()
        assert plan.axes() == axes and plan.brakingEnd() == 0 and plan.iterations() >= 1
        for i in range(axes):
            sampled = []
            for piece in plan.pieces():
                t = np.linspace(0, piece.duration, 50)
                sampled.append(derivatives(piece.coefficients[i], t))
                np.testing.assert_allclose(plan.sample(i, piece.begin + t)[:, 0], sampled[-1][0], atol=1e-9)
            x = np.concatenate(sampled, axis=1)
            peaks = plan.peaks(i)
            assert np.abs(x[1]).max() <= min(peaks.velocity, problem.maxVelocity[i]) + 1e-9
            assert np.abs(x[2]).max() <= min(peaks.acceleration, problem.maxAcceleration[i]) + 1e-9
            assert peaks.minPosition - 1e-9 <= x[0].min() and x[0].max() <= peaks.maxPosition + 1e-9
            # the peaks are reached, not only bounds
            assert np.abs(x[1]).max() >= 0.98 * peaks.velocity
            np.testing.assert_allclose(plan.at(i, plan.duration())[:3], [problem.goal.q[i], 0, 0], atol=1e-12)
            assert plan.arrival(i) == plan.duration() and isinstance(plan.form(i), vd.TrajectoryForm)
            assert sum(s.duration for s in plan.segments(i)) == pytest.approx(plan.duration())


def test_steps_follow_the_plan(random):
    for _ in range(longer(20)):
        problem = random_problem(random, 3)
        _, plan = vd.DirectTrajectory.calculate(problem)
        trajectory = vd.DirectTrajectory(3)
        times, states = [], []
        while True:
            output = trajectory.step(problem, 0.01)
            if not vd.isWorking(output.status.result):
                break
            times.append(output.time)
            states.append(output.state.q)
            assert output.duration == pytest.approx(plan.duration()) and output.remaining >= 0
        assert output.status.result == vd.TrajectoryResult.Finished
        np.testing.assert_array_equal(output.state.q, problem.goal.q)
        for i in range(3):
            np.testing.assert_allclose(np.array(states)[:, i], trajectory.plan().sample(i, times)[:, 0], atol=1e-12)
        trajectory.reset()
        assert trajectory.step(problem, 0.01).newPlan


def test_vias_groups_and_options(random):
    problem = vd.TrajectoryInput(2, maxVelocity=[1, 1], maxAcceleration=[2, 2])
    problem.goal.q = [1, 0.5]
    problem.vias = [vd.TrajectoryVia(2, tau=0.5, q=[0.2, 0.6])]
    status, plan = vd.DirectTrajectory.calculate(problem)
    assert status.isGood() and len(plan.viaTimes()) == 1
    np.testing.assert_allclose([plan.at(i, plan.viaTimes()[0])[0] for i in (0, 1)], [0.2, 0.6], atol=1e-9)
    problem.vias = [vd.TrajectoryVia(2, q=[0.2, 0.6])]  # no tau: chosen
    chosen = vd.DirectTrajectory.calculate(problem)[1].duration()
    assert vd.DirectTrajectory.optimiseVias(problem).isGood()
    assert 0 < problem.vias[0].tau < 1 and problem.vias[0].hasVelocity
    assert vd.DirectTrajectory.calculate(problem)[1].duration() <= chosen < plan.duration()
    problem.vias = []
    problem.spec.groups = [vd.AxisGroup(axes=3, maxSpeed=0.3)]
    assert problem.spec.groups[0].contains(1) and not problem.spec.groups[0].contains(2)
    status, plan = vd.DirectTrajectory.calculate(problem)
    speed = np.hypot(
        plan.sample(0, np.linspace(0, plan.duration(), 500))[:, 1],
        plan.sample(1, np.linspace(0, plan.duration(), 500))[:, 1],
    )
    assert speed.max() <= 0.3 + 1e-9 and speed.max() > 0.29
    assert plan.peakNorm(3, 1) == pytest.approx(speed.max(), rel=1e-3)
    with pytest.raises(ValueError, match="5 groups were given, must be at most 4"):
        problem.spec.groups = [vd.AxisGroup()] * 5


def test_bad_input_has_a_sentence():
    problem = vd.TrajectoryInput(2)
    trajectory = vd.DirectTrajectory(2)
    for change, sentence in (
        (lambda p: setattr(p, "maxVelocity", [1, -1]), "velocity limit of axis 1 is -1, must be > 0"),
        (lambda p: setattr(p.goal, "q", [1, np.nan]), "goal"),
        (lambda p: setattr(p.goal, "q", [1, 2, 3]), "3"),
    ):
        bad = vd.TrajectoryInput(2)
        change(bad)
        status = trajectory.step(bad, 0.01).status
        assert status.result == vd.TrajectoryResult.InvalidInput and not status.isGood()
        assert sentence in status.message()
    assert vd.LimitExcess(limit=vd.TrajectoryLimit.Velocity, value=3, bound=1).amount() == 2
    with pytest.raises(TypeError, match="TrajectoryInput has no field maxSpeed"):
        vd.TrajectoryInput(2, maxSpeed=[1, 1])
    with pytest.raises(ValueError, match="the number of axes is 0"):
        vd.DirectTrajectory(0)
    with pytest.raises(IndexError, match="axis 2 does not exist, there are 2"):
        trajectory.plan().peaks(2)
    with pytest.raises(ValueError, match="read-only"):
        problem.goal.q[0] = 1  # a copy: would be without effect
    with pytest.raises(ValueError, match=r"an array of shape \(1, 2\) was given, must be n numbers"):
        problem.goal.q = [[1, 2]]
    with pytest.raises(TypeError, match="a str was given, must be numbers"):
        problem.goal.q = "12"
    with pytest.raises(TypeError, match=r"an array of shape \(2,\) with dtype complex128 was given, must be numbers"):
        problem.goal.q = np.array([1j, 2])


def test_pose_trajectory_keeps_limits_and_arrives(random):
    for _ in range(longer(20)):
        spec = vd.PoseTrajectorySpec(linearVelocity=random.uniform(0.1, 1), angularVelocity=random.uniform(0.2, 1))
        spec.validate()
        trajectory = vd.PoseTrajectory(spec)
        goal = pose(random.uniform(-1, 1, 3), random.uniform(-1, 1, 3))
        assert trajectory.reset(pose(random.uniform(-1, 1, 3))).isGood() and trajectory.setGoal(goal).isGood()
        before, dt = trajectory.state().fMc, 0.01
        status = trajectory.step(dt)
        assert trajectory.duration() > 0 and trajectory.remaining() <= trajectory.duration()
        assert trajectory.plan().axes() == 6
        while vd.isWorking(status.result):
            state = trajectory.state()
            np.testing.assert_allclose(state.fMc[:3, 3], state.ftc)
            assert np.linalg.norm(state.fMc[:3, 3] - before[:3, 3]) <= spec.linearVelocity * dt * (1 + 1e-6)
            angle = np.arccos(np.clip((np.trace(before[:3, :3].T @ state.fMc[:3, :3]) - 1) / 2, -1, 1))
            assert angle <= spec.angularVelocity * dt * (1 + 1e-6) + 1e-7
            assert np.linalg.norm(state.v[:3]) <= spec.linearVelocity * (1 + 1e-9)
            before = state.fMc
            status = trajectory.step(dt)
        np.testing.assert_allclose(trajectory.state().fMc, goal, atol=1e-9)
        np.testing.assert_allclose(trajectory.at(trajectory.duration()).fMc, goal, atol=1e-9)
    trajectory.setSpec(vd.PoseTrajectorySpec())
    with pytest.raises(ValueError, match="linear velocity limit of the pose trajectory is -1 m/s, must be > 0"):
        trajectory.setSpec(vd.PoseTrajectorySpec(linearVelocity=-1))


def test_poses_are_checked():
    trajectory = vd.PoseTrajectory()
    bad = pose([0, 0, 0])
    bad[0, 3] = np.nan
    for given, sentence in (
        (np.eye(3), r"an array of shape \(3, 3\) was given, must be 4 x 4 numbers"),
        (bad, "not finite"),
        (2 * np.eye(4), "last row"),
        (np.diag([2.0, 1, 1, 1]), "off by 3, must be orthonormal"),
        (np.diag([-1.0, 1, 1, 1]), "reflection"),
    ):
        with pytest.raises(ValueError, match=sentence):
            trajectory.setGoal(given)
    trajectory.setGoal(pose([0, 0, 0.1]).tolist())  # numbers are numbers


def test_twist_shaper_bounds_the_acceleration(random):
    limits = vd.TwistShaperLimits(linearAcceleration=0.5, linearJerk=4, angularAcceleration=1, angularJerk=8)
    limits.validate()
    shaper = vd.TwistShaper(limits)
    shaper.setLimits(limits)
    shaper.reset()
    before, dt = np.zeros(6), 0.01
    for k in range(longer(500)):
        raw = random.uniform(-1, 1, 6) if k % 20 == 0 else raw
        twist = shaper.step(raw, dt)
        assert np.linalg.norm((twist - before)[:3]) <= 0.5 * dt * (1 + 1e-9)
        assert np.linalg.norm((twist - before)[3:]) <= 1.0 * dt * (1 + 1e-9)
        assert np.linalg.norm(shaper.acceleration()[:3]) <= 0.5 * (1 + 1e-9)
        before = twist
    np.testing.assert_array_equal(before, shaper.twist())
    with pytest.raises(ValueError, match="linearJerk"):
        shaper.setLimits(vd.TwistShaperLimits(linearJerk=-1))


def test_limit_twist(random):
    for _ in range(longer(200)):
        twist = random.uniform(-2, 2, 6)
        limited = vd.limitTwist(twist, 1, 0.5)
        factor = min(1, 1 / np.linalg.norm(twist[:3]), 0.5 / np.linalg.norm(twist[3:]))
        np.testing.assert_allclose(limited, factor * twist, rtol=1e-12)
    with pytest.raises(ValueError, match=r"an array of shape \(5,\) was given, must be 6 numbers"):
        vd.limitTwist(np.zeros(5), 1, 1)


def test_plan_of_bad_size():
    assert vd.TrajectoryPlan(3).duration() == 0
    with pytest.raises(ValueError, match="n numbers"):
        vd.TrajectoryPlan(3).sample(0, [[1, 2]])
