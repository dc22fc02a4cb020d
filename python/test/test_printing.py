# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Print reference and trigger: a product that moves as the reference says gets one drop in each cell."""
import numpy as np
import pytest
import visp_direct as vd
from conftest import longer


def test_reference_passes_its_targets(random):
    for _ in range(longer(20)):
        spec = vd.PrintReferenceSpec(meanVelocity=random.uniform(3, 6))
        spec.validate()
        reference = vd.PrintReference(spec)
        assert reference.spec().meanVelocity == spec.meanVelocity
        reference.reset(0, 0, 0)
        targets = [vd.PrintTarget(key=k, position=48.9 * k + random.uniform(-1, 1), velocity=4) for k in range(1, 6)]
        passed, before = {}, None
        for now in np.arange(0, 90, 0.25):
            output = reference.step(now, targets)
            assert output.valid
            if before is not None and output.newTarget and before.hasTarget:
                passed[before.target] = before.arrival
            before = output
            np.testing.assert_array_equal(reference.output().state, output.state)
            future = reference.at(now + 2)
            pieces = [p for p in reference.pieces() if p.begin <= now + 2 <= p.begin + p.duration]
            if pieces:
                s = (now + 2 - pieces[0].begin) / pieces[0].duration
                assert future[0] == pytest.approx(np.polynomial.Polynomial(pieces[0].p)(s), abs=1e-9)
        assert len(passed) >= 3
    assert not reference.step(np.nan, targets).valid
    with pytest.raises(ValueError, match="meanVelocity"):
        vd.PrintReferenceSpec(meanVelocity=-1).validate()


def test_forecast_follows_its_numbers_and_its_plan():
    forecast = vd.MotionForecast(time=1, position=2, velocity=3)
    assert forecast.isPlausible()
    np.testing.assert_allclose(forecast.at(2)[:2], [5, 3])
    forecast.plan = [vd.TrajectorySegment(begin=1, duration=2, p=[2, 6])]
    assert forecast.pieces == 1 and len(forecast.plan) == 1
    np.testing.assert_allclose(forecast.at(2)[:2], [5, 3])
    assert not vd.MotionForecast(position=np.nan).isPlausible()
    with pytest.raises(ValueError, match="5 pieces were given"):
        forecast.plan = [vd.TrajectorySegment()] * 5


def cells_at(shift, noise=None):
    """Cells of one row, 20 px apart, in a view of 160 px; column numbers stay with them."""
    columns = np.arange(-40, 1)
    x = 79.5 + 20 * columns + 30 + shift
    seen = (x > 5) & (x < 155)
    cells = np.zeros(seen.sum(), vd.PatternCell)
    cells["column"], cells["x"], cells["y"] = columns[seen], x[seen], 49.5
    if noise is not None:
        cells["x"] += noise.normal(0, 0.05, len(cells))
    cells["sigmaX"] = cells["sigmaY"] = 0.05
    cells["valid"] = True
    return cells


def test_trigger_fires_once_at_each_cell(random):
    for _ in range(longer(10)):
        velocity, travel, delay = random.uniform(2, 5), random.uniform(0, 0.9), random.uniform(0, 2)
        trigger = vd.PrintTrigger(vd.PrintTriggerSpec(travelTime=travel, drift=1e-6))
        trigger.spec().validate()
        fired = {}
        for now in range(150):
            given = vd.PrintTriggerInput(
                time=now,
                captureTime=now - delay,
                cells=cells_at(velocity * (now - delay), random),
                captureAlong=velocity * (now - delay),
                along=vd.MotionForecast(time=now, position=velocity * now, velocity=velocity),
            )
            output = trigger.step(given)
            assert output.status == vd.PrintTriggerStatus.Good and not output.overflow
            assert output.message().split(":")[0] == ("Missed" if len(output.missed) else "Good")
            for shot in output.shots:
                assert now <= shot["fireTime"] < now + 1 and shot["column"] not in fired
                fired[shot["column"]] = shot["landTime"]
            assert len(output.missed) == 0 and (output.planned["fireTime"] >= now).all()
        assert trigger.remembered() > 0
        expected = {c: -(20 * c + 30) / velocity for c in range(-40, 0) if 3 < -(20 * c + 30) / velocity < 140}
        assert set(expected) <= set(fired)
        for column, time in expected.items():
            assert fired[column] == pytest.approx(time, abs=0.2 / velocity)
    along, across = trigger.find(-5, 0, 0) or trigger.find(0, -5, 0)
    assert across == pytest.approx(49.5, abs=1) and along == pytest.approx(79.5 - 100 + 30, abs=1)
    assert trigger.find(7, 7, 7) is None
    trigger.reset()
    assert trigger.remembered() == 0


def test_bad_input_has_a_sentence_or_a_status():
    trigger = vd.PrintTrigger()
    assert trigger.step(vd.PrintTriggerInput(time=np.nan)).status == vd.PrintTriggerStatus.InputRefused
    given = vd.PrintTriggerInput(cells=cells_at(0))
    np.testing.assert_array_equal(given.cells, cells_at(0))
    with pytest.raises(TypeError, match="a float was given|dtype visp_direct.PatternCell"):
        given.cells = np.zeros((3, 2))
    with pytest.raises(ValueError, match="must have one dimension"):
        given.cells = np.zeros((3, 2), vd.PatternCell)
    with pytest.raises(ValueError, match="nozzle"):
        vd.PrintTrigger(vd.PrintTriggerSpec(nozzle=np.nan))


def test_machine_prints_each_cell_of_a_row_once():
    """On a stage that is a mass alone, accelerated by four commands in each frame, seen without delay."""
    preview = vd.PreviewControlSpec(lag=0, positionGain=0.03, velocityGain=0.5)
    spec = vd.PrintMachineSpec(cellsPerRow=8, visionDelay=0, commandsPerFrame=4, preview=preview, previewAcross=preview)
    spec.observer = vd.MotionObserverSpec(lag=0)
    spec.originX = spec.nozzle - spec.pitchX  # a distance to accelerate
    spec.validate()
    machine = vd.PrintMachine(spec)
    assert machine.spec().cellsPerRow == 8 and [machine.columnOf(0, k) for k in range(3)] == [-1, -2, -3]
    machine.reset(0, -1)
    places, velocity, shots, missed = [0.0], 0.0, [], []  # places: each quarter of a frame
    columns = -1 - np.arange(8)
    for frame in range(200):
        x = spec.originX + (columns + 1) * spec.pitchX + places[-1]
        seen = (x > 0) & (x < 160)
        cells = np.zeros(seen.sum(), vd.PatternCell)
        cells["column"], cells["x"], cells["y"], cells["valid"] = columns[seen], x[seen], spec.nozzleAcross, True
        cells["sigmaX"] = cells["sigmaY"] = 0.02
        output = machine.step(frame, cells, 1)
        assert output.commandCount == 4 and np.isfinite(output.forceX).all() and repr(output).startswith("PrintMachineOutput(")
        shots += [(shot["column"], shot["fireTime"]) for shot in output.trigger.shots]
        missed += output.trigger.missed["column"].tolist()
        for force in output.forceX[:4]:
            places.append(places[-1] + velocity / 4 + force / 32)
            velocity += force / 4
    assert sorted(column for column, _ in shots) == sorted(columns) and missed == []
    for column, time in shots:
        landed = np.interp(time + spec.travelTime, np.arange(len(places)) / 4, places)
        assert abs(spec.originX + (column + 1) * spec.pitchX + landed - spec.nozzle) < 0.1
    empty = machine.step(frame + 1, np.zeros(0, vd.PatternCell))
    assert empty.commandCount == 4 and np.isfinite(empty.forceX).all()
    assert np.isfinite(machine.step(np.nan, np.zeros(0, vd.PatternCell)).forceX).all()
    with pytest.raises(TypeError, match="dtype visp_direct.PatternCell"):
        machine.step(0, np.zeros((2, 2)))
    with pytest.raises(ValueError, match="pitchX"):
        vd.PrintMachine(vd.PrintMachineSpec(pitchX=np.nan))


def test_parameters_of_the_machine_check_themselves(random):
    for _ in range(longer(20)):
        alpha = random.uniform(0.05, 0.95)
        gains, kalman = vd.AlphaBetaGains.criticallyDamped(alpha), vd.AlphaBetaGains.steadyKalman(alpha)
        gains.validate()
        assert gains.beta == pytest.approx(2 - alpha - 2 * np.sqrt(1 - alpha))
        assert kalman.beta == pytest.approx(2 * gains.beta)
        assert 0 < gains.valueVariance() < 1 and gains.rateVariance() > 0
        model = vd.FrictionModel(mass=random.uniform(0.5, 2), viscous=0.1, coulomb=0.3, stiction=0.3)
        v, a = random.uniform(-1, 1, 2)
        assert model.friction(v) == pytest.approx(0.1 * v + 0.3 * np.sign(v))
        assert model.force(v, a) == pytest.approx(model.mass * a + model.friction(v))
    assert not vd.PrintVelocityControlSpec.thesisPid().feedforward and vd.PrintVelocityControlSpec.thesisFeedforward().feedforward
    vd.PrintMachineSpec.defaultForecast().validate()
    assert vd.PrintMachineSpec().controller == vd.PrintController.Observer
    bad = {"MotionKalmanSpec": "gate", "MotionObserverSpec": "lag", "PreviewControlSpec": "period", "PrintVelocityControlSpec": "kp"}
    for name, field in {**bad, "PrintMachineSpec": "dropVelocity", "AlphaBetaGains": "alpha"}.items():
        with pytest.raises(ValueError, match=field):
            getattr(vd, name)(**{field: np.nan}).validate()
