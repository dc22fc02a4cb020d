# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Filters and observers of a motion, control and friction of one axis: against closed forms and least squares."""
import numpy as np
import pytest
import visp_direct as vd
from conftest import longer
from test_printing import cells_at


def test_alpha_beta_filter_is_its_formula(random):
    for _ in range(longer(20)):
        T, gains = random.uniform(0.5, 2), vd.AlphaBetaGains(alpha=random.uniform(0.1, 0.9), beta=random.uniform(0.01, 0.5))
        made = vd.AlphaBetaFilter(gains, T)
        x, v = random.uniform(-5, 5, 2)
        made.reset(x, v)
        for z, u in random.uniform(-5, 5, (20, 2)):
            x, v = x + T * v + T * T * u / 2, v + T * u
            if z > -3:
                residual = z - x
                x, v = x + gains.alpha * residual, v + gains.beta * residual / T
                state = made.step(z, u)
                assert state.measured and state.residual == pytest.approx(residual)
            else:
                state = made.skip(u)
                assert not state.measured
            assert (state.value, state.rate) == pytest.approx((x, v)) and made.predict(3) == pytest.approx(x + 3 * v)
        made.reset()
        assert not made.state().started and made.step(4).value == 4 and made.gains().beta == gains.beta
        assert not made.step(np.nan).measured
    with pytest.raises(ValueError, match="alpha"):
        vd.AlphaBetaFilter(vd.AlphaBetaGains(alpha=-1))


def test_kalman_filter_is_least_squares_in_any_order(random):
    """Without process noise: the line through all readings and the initial state, weighted by their deviations."""
    spec = vd.MotionKalmanSpec(model=vd.MotionModel.ConstantVelocity, processNoise=1e-12, gate=np.inf, maxDelay=30)
    for _ in range(longer(10)):
        made, (p, v) = vd.MotionKalmanFilter(spec), random.uniform(-5, 5, 2)
        made.reset(0, 0, 0)
        times, sigmas = random.uniform(0, 20, 15), random.uniform(0.1, 1, 15)
        values = p + v * times + random.normal(0, sigmas)
        for t, z, sigma in zip(times, values, sigmas):
            assert made.add(vd.MotionReading(time=t, value=z, sigma=sigma)) == vd.MotionReadingResult.Used
        A = np.r_[np.c_[np.ones(15), times] / sigmas[:, None], np.diag([1 / spec.sigmaPosition, 1 / spec.sigmaVelocity])]
        (p, v), covariance = np.linalg.lstsq(A, np.r_[values / sigmas, 0, 0], rcond=None)[0], np.linalg.inv(A.T @ A)
        now = made.at(25)
        assert now.asAsked and (now.position, now.velocity) == pytest.approx((p + 25 * v, v), abs=1e-4)
        assert now.sigmaVelocity == pytest.approx(covariance[1, 1] ** 0.5, rel=1e-3)
        assert now.covariance.shape == (3, 3) and now.covariance[0, 0] == pytest.approx(now.sigmaPosition**2)
    made = vd.MotionKalmanFilter(vd.MotionKalmanSpec(sigmaPosition=1))
    for value, result in ((np.nan, "Invalid"), (1e6, "Outlier"), (0.5, "Used")):
        assert made.add(vd.MotionReading(time=1, value=value)) == getattr(vd.MotionReadingResult, result)
    kind = vd.MotionReadingKind.Displacement
    assert made.add(vd.MotionReading(kind=kind, time=1, value=1)) == vd.MotionReadingResult.NoMark
    assert made.outliers() == 1 and made.spec().sigmaPosition == 1
    with pytest.raises(ValueError, match="gate"):
        vd.MotionKalmanFilter(vd.MotionKalmanSpec(gate=-1))


def test_observer_knows_the_present_from_what_was(random):
    """A mass without friction behind a lag, under a constant force, seen three frames late."""
    for _ in range(longer(10)):
        mass, lag, force = random.uniform(0.5, 2), random.uniform(0.2, 1), random.uniform(-1, 1)

        def truth(t):
            decay = np.exp(-t / lag)
            return force / mass * (t * t / 2 - lag * t + lag * lag * (1 - decay)), force / mass * (t - lag * (1 - decay))

        spec = vd.MotionObserverSpec(model=vd.FrictionModel(mass=mass), lag=lag, disturbanceNoise=1e-12, sigmaDisturbance=1e-6)
        observer = vd.MotionObserver(spec)
        observer.reset(0, 0)
        assert observer.command(0, force) and observer.spec().lag == lag
        for t in range(1, 20):
            assert observer.measure(t, truth(t)[0], 1e-3) == vd.MotionReadingResult.Used
        now = observer.at(22)
        assert (now.position, now.velocity) == pytest.approx(truth(22), rel=1e-3, abs=1e-3)
        assert now.force == pytest.approx(force, abs=1e-6) and now.sigmaPosition > 0 and now.asAsked
    assert not observer.command(np.nan, 0) and not observer.command(-1, 0)
    assert observer.measure(21, np.nan, 1) == vd.MotionReadingResult.Invalid
    assert observer.measure(1, 0, 1) == vd.MotionReadingResult.TooLate
    assert observer.measure(1e5, 0, 1) == vd.MotionReadingResult.ImplausibleTime
    with pytest.raises(ValueError, match="delay"):
        vd.MotionObserver(vd.MotionObserverSpec(delay=np.nan))


def test_odometer_adds_what_the_cells_move(random):
    odometer, moved, before = vd.ProductOdometer(), 0, cells_at(0)
    odometer.step(before)
    for _ in range(longer(50)):
        dx = random.uniform(0, 5)
        moved += dx
        now = cells_at(moved % 600)
        velocity = vd.findCellVelocity(before, now, 2)
        if moved % 600 > dx:
            assert velocity.cells > 3 and velocity.vx == pytest.approx(dx / 2) and velocity.vy == pytest.approx(0)
        output = odometer.step(now, predictedX=dx)
        assert output.x == pytest.approx(moved) and not output.lost
        before = now
    assert not odometer.step(np.zeros(0, vd.PatternCell), predictedX=3).measured
    assert odometer.output().x == pytest.approx(moved + 3)
    assert odometer.step(cells_at(0), 1, np.nan).lost
    odometer.reset()
    assert odometer.output().x == 0
    with pytest.raises(TypeError, match="dtype visp_direct.PatternCell"):
        odometer.step(np.zeros((3, 2)))
    with pytest.raises(ValueError, match="capacity"):
        vd.ProductOdometer(0)


def test_controls_of_an_axis_are_their_formulas(random):
    for _ in range(longer(20)):
        kp, ki, kd, most = random.uniform(0.01, 1, 4)
        control, last = vd.PrintVelocityControl(vd.PrintVelocityControlSpec(kp=kp, ki=ki, kd=kd, maxForce=most)), 0
        for error in random.uniform(-1, 1, 10):
            output = control.step(vd.PrintVelocityControlInput(velocity=2 + error, measured=2))
            assert output.valid and output.saturated == (abs(output.feedback) > most)
            assert output.feedback == pytest.approx(kp * error + ki * control.integral() + kd * (error - last))
            assert output.force == pytest.approx(np.clip(output.feedback, -most, most))
            last = error
        assert control.spec().kd == kd
        control.reset()
        assert control.integral() == 0
        model = vd.FrictionModel(mass=random.uniform(0.5, 2), viscous=random.uniform(0, 1))
        spec = vd.PreviewControlSpec(model=model, positionGain=kp, velocityGain=ki, lag=kd, delay=most, period=2)
        preview, (p, v, a, j, q, w, d) = vd.PreviewControl(spec), random.uniform(-1, 1, 7)
        given = vd.PreviewControlInput(reference=[p, v, a, j], referenceFeedback=[q, w, 0, 0], disturbance=d)
        force = model.force(v, a) + kd * (model.mass * j + model.viscous * a) + kp * q + ki * w + d
        output = preview.command(given)
        assert output.valid and output.force == pytest.approx(force)
        assert preview.actsAt(1) == pytest.approx(2 + most) and preview.feedbackAt(1) == pytest.approx(1 + most)
    assert preview.spec().lag == kd and not preview.command(vd.PreviewControlInput(position=np.nan)).valid
    assert not control.step(vd.PrintVelocityControlInput(velocity=np.inf)).valid
    with pytest.raises(ValueError, match="period"):
        vd.PreviewControl(vd.PreviewControlSpec(period=0))


def test_friction_is_found_in_a_log(random):
    spec = vd.FrictionIdentificationSpec(stribeck=False)
    spec.validate()
    for _ in range(longer(10)):
        model = vd.FrictionModel(mass=random.uniform(0.5, 2), viscous=random.uniform(0.01, 0.1), coulomb=random.uniform(0.1, 0.5))
        model.stiction = model.coulomb
        v, a = random.uniform(1, 5, 500) * random.choice([-1, 1], 500), random.uniform(-1, 1, 500)
        forces = [model.force(*x) for x in zip(v, a)] + random.normal(0, 0.01, 500)
        found = vd.identifyFriction(np.c_[forces, v, a], spec)
        assert found.status in (vd.FrictionStatus.Good, vd.FrictionStatus.Misfit) and found.message()
        for name, sigma in (("mass", found.sigmaMass), ("viscous", found.sigmaViscous), ("coulomb", found.sigmaCoulomb)):
            assert getattr(found.model, name) == pytest.approx(getattr(model, name), abs=6 * sigma)
        assert found.noise == pytest.approx(0.01, rel=0.3)
    assert vd.identifyFriction(np.zeros((3, 3))).status == vd.FrictionStatus.TooFewSamples
    assert vd.identifyFriction(np.full((99, 3), np.nan)).status == vd.FrictionStatus.NotFinite
    with pytest.raises(ValueError, match=r"shape \(9, 2\) was given, must be n x 3 numbers"):
        vd.identifyFriction(np.zeros((9, 2)))
