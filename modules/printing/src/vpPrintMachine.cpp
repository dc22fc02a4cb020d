/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"

#include <visp3/printing/vpPrintMachine.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the print machine");

void requirePositive(const char *field, double value) { fields.positive(field, value); }

vpPrintMachineSpec validated(const vpPrintMachineSpec &spec)
{
  spec.validate();
  return spec;
}

vpPrintTriggerSpec triggerOf(const vpPrintMachineSpec &spec)
{
  vpPrintTriggerSpec trigger;
  trigger.method = spec.trigger;
  trigger.nozzle = spec.nozzle;
  trigger.nozzleAcross = spec.nozzleAcross;
  trigger.rowTolerance = 0.4 * spec.pitchY;
  trigger.travelTime = spec.travelTime;
  trigger.electronicsDelay = spec.electronicsDelay;
  trigger.tolerance = spec.lateTolerance;
  trigger.drift = spec.cellDrift;
  trigger.match = 0.4 * std::min(spec.pitchX, spec.pitchY);
  return trigger;
}

vpPreviewControlSpec withPeriod(vpPreviewControlSpec preview, int commandsPerFrame)
{
  preview.period = 1. / commandsPerFrame;
  return preview;
}

double previewForce(const vpPreviewControl &control, double now, const vpMotionObserver &observer,
                    const vpPrintReference &reference)
{
  const vpObservedMotion motion = observer.at(control.feedbackAt(now)); // predicted for when the command acts
  vpPreviewControl::Input input;
  input.reference = reference.at(control.actsAt(now));
  input.referenceFeedback = reference.at(control.feedbackAt(now));
  input.position = motion.position;
  input.velocity = motion.velocity;
  input.disturbance = motion.velocity == 0. && input.reference[1] == 0. ? 0. : motion.disturbance;
  return control.command(input).force;
}
} // namespace

vpMotionKalmanSpec vpPrintMachineSpec::defaultForecast()
{
  vpMotionKalmanSpec forecast;
  forecast.processNoise = 0.05;
  forecast.sigmaPosition = 1.;
  forecast.sigmaVelocity = 0.01;
  forecast.sigmaAcceleration = 0.01;
  forecast.maxDelay = 0.;
  return forecast;
}

void vpPrintMachineSpec::validate() const
{
  requirePositive("pitchX", pitchX);
  requirePositive("pitchY", pitchY);
  fields.finite("originX", originX);
  fields.finite("nozzle", nozzle);
  fields.finite("nozzleAcross", nozzleAcross);
  requirePositive("sigmaX", sigmaX);
  requirePositive("sigmaY", sigmaY);
  filter.validate();
  fields.in("filterAhead", filterAhead, {0., 64.});
  pid.validate();
  forecast.validate();
  observer.validate();
  preview.validate();
  previewAcross.validate();
  fields.require(commandsPerFrame == 1 || commandsPerFrame == 2 || commandsPerFrame == 4 || commandsPerFrame == 8 ||
                     commandsPerFrame == 16,
                 "commandsPerFrame", commandsPerFrame, "1, 2, 4, 8 or 16");
  reference.validate();
  requirePositive("dropVelocity", dropVelocity);
  requirePositive("rowStepTime", rowStepTime);
  requirePositive("followTime", followTime);
  fields.in("visionDelay", visionDelay, {0., 8.});
  triggerOf(*this).validate();
  fields.in("rows", rows, {1, 1000});
  fields.in("cellsPerRow", cellsPerRow, {1, 10000});
  const bool wanted = controller == vpPrintController::PidFeedforward;
  fields.require(controller == vpPrintController::Observer || pid.feedforward == wanted, "pid.feedforward",
                 pid.feedforward ? 1. : 0., "1 with PidFeedforward and 0 with Pid");
}

vpPrintMachine::vpPrintMachine(const vpPrintMachineSpec &spec)
  : m_spec(validated(spec)), m_trigger(triggerOf(spec)), m_reference(spec.reference),
    m_referenceY(vpPrintReferenceSpec()), m_pid(spec.pid), m_preview(withPeriod(spec.preview, spec.commandsPerFrame)),
    m_previewAcross(withPeriod(spec.previewAcross, spec.commandsPerFrame)), m_observer(spec.observer),
    m_observerY(spec.observer), m_alphaBeta(spec.filter), m_kalman(spec.forecast)
{
  reset();
}

void vpPrintMachine::reset(int firstRow, int firstColumn) noexcept
{
  m_firstRow = firstRow;
  m_firstColumn = firstColumn;
  m_trigger.reset();
  m_reference.reset(0., 0., -1);
  m_referenceY.reset(0., 0., 0);
  m_pid.reset();
  m_alphaBeta.reset();
  m_kalman.reset(-m_spec.visionDelay);
  m_observer.reset(-m_spec.visionDelay - 1.);
  m_observerY.reset(-m_spec.visionDelay - 1.);
  m_odometer.reset();
  m_output = vpPrintMachineOutput();
  m_output.commandCount = m_spec.commandsPerFrame;
  m_targetCount = 0;
  m_targetY = vpPrintTarget();
  m_lastCapture = 0.;
  m_seen = m_turning = false;
  m_present = 0;
  m_stepArrival = m_acrossOffset = m_knownAlong = 0.;
  m_knownRow = -1;
  m_knownColumn = 0;
  m_epoch = 0;
}

int vpPrintMachine::columnOf(int row, int k) const noexcept
{
  return row % 2 == 0 ? m_firstColumn - k : m_firstColumn - m_spec.cellsPerRow + 1 + k;
}

const vpPrintMachineOutput &vpPrintMachine::step(const vpPrintMachineInput &input) noexcept
{
  see(input);
  makeTargets();
  makeTargetAcross(input.time);
  follow(input.time);
  m_output.estimatedVelocity = m_observer.at(input.time).velocity;
  if (!isObserved()) {
    m_output.forceX.fill(pidForce());
  }
  fire(input);
  drive(input.time);
  return m_output;
}

void vpPrintMachine::see(const vpPrintMachineInput &input) noexcept
{
  m_seen = input.cellCount > 0;
  if (!m_seen) {
    return;
  }
  m_epoch = input.epoch;
  const double capture = input.time - m_spec.visionDelay, gap = capture - m_lastCapture;
  const vpProductOdometer::Output &moved =
      m_odometer.step(input.cells, input.cellCount, input.epoch, positionAt(capture) - positionAt(m_lastCapture), 0.);
  if (moved.measured && gap > 0.) {
    m_output.measuredVelocity = moved.dx / gap;
  }
  m_lastCapture = capture;
  m_alphaBeta.step(m_output.measuredVelocity);
  m_kalman.add({vpMotionReadingKind::Position, capture, moved.x, m_spec.sigmaX});
  m_observer.measure(capture, moved.x, m_spec.sigmaX);
  m_observerY.measure(capture, moved.y, m_spec.sigmaY);
}

double vpPrintMachine::positionAt(double time) const noexcept
{
  return isObserved() ? m_observer.at(time).position : m_kalman.at(time).position;
}

// Displacement at which a cell is at the nozzle, if known: measured, or from its neighbour by the pitch.
double vpPrintMachine::placeOf(int row, int column) noexcept
{
  double along = 0., across = 0.;
  if (m_trigger.find(m_firstRow + row, column, m_epoch, along, across)) {
    m_knownRow = row;
    m_knownColumn = column;
    m_knownAlong = along;
    return m_spec.nozzle - along;
  }
  if (m_knownRow == row) {
    return m_spec.nozzle - m_knownAlong - (column - m_knownColumn) * m_spec.pitchX;
  }
  return m_spec.nozzle - m_spec.originX - (column - m_firstColumn) * m_spec.pitchX;
}

// The cells from the current one on, and the turns between the rows.
void vpPrintMachine::makeTargets() noexcept
{
  const long perRow = m_spec.cellsPerRow + 1L;
  const double turn = 2. * m_spec.pitchX / m_spec.dropVelocity;
  const long begin = std::max(0L, m_present - 1);
  m_targetCount = 0;
  for (long key = begin; key < begin + static_cast<long>(m_targets.size()); ++key) {
    const int row = static_cast<int>(key / perRow), k = static_cast<int>(key % perRow);
    if (row >= m_spec.rows) {
      break;
    }
    vpPrintTarget &target = m_targets[m_targetCount++];
    target.key = key;
    if (k < m_spec.cellsPerRow) {
      target.position = placeOf(row, columnOf(row, k));
      target.velocity = direction(row) * m_spec.dropVelocity;
      target.duration = k == 0 && row > 0 ? turn : 0.;
    }
    else {
      target.position = placeOf(row, columnOf(row, k - 1)) + direction(row) * m_spec.pitchX;
      target.velocity = 0.;
      target.duration = turn;
    }
  }
  m_output.row = std::min(static_cast<int>(m_present / perRow), m_spec.rows - 1);
}

// The nozzle follows the cells across the rows, too: the mean of the next three, as measured. After the last cell of a
// row the stage steps to the next one.
void vpPrintMachine::makeTargetAcross(double now) noexcept
{
  const long perRow = m_spec.cellsPerRow + 1L;
  const bool turning = m_present % perRow == m_spec.cellsPerRow;
  const int row = std::min(turning ? m_output.row + 1 : m_output.row, m_spec.rows - 1);
  const int first = turning ? 0 : static_cast<int>(m_present % perRow);
  double sum = 0.;
  int known = 0;
  for (int k = first; k < std::min(first + 3, m_spec.cellsPerRow); ++k) {
    double along = 0., across = 0.;
    if (m_trigger.find(m_firstRow + row, columnOf(row, k), m_epoch, along, across)) {
      sum += m_spec.nozzleAcross - across;
      ++known;
    }
  }
  const double regular = -row * m_spec.pitchY;
  m_acrossOffset = known > 0 ? sum / known - regular : m_acrossOffset;
  m_targetY.key = m_present + 1;
  m_targetY.position = regular + m_acrossOffset;
  m_targetY.velocity = 0.;
  m_stepArrival = turning && !m_turning ? now + m_spec.rowStepTime : m_stepArrival;
  m_turning = turning;
  m_targetY.duration = std::max(m_stepArrival - now, m_spec.followTime);
}

void vpPrintMachine::follow(double now) noexcept
{
  const vpPrintReference::Output &reference = m_reference.step(now, m_targets.data(), m_targetCount);
  if (reference.hasTarget) {
    m_present = reference.target;
  }
  else if (m_targetCount > 0 && now > 1.) {
    m_present = m_targets[m_targetCount - 1].key;
  }
  m_referenceY.step(now, &m_targetY, 1);
  m_output.reference = m_reference.at(now);
}

double vpPrintMachine::pidForce() noexcept
{
  if (!m_seen) {
    m_alphaBeta.skip();
  }
  vpPrintVelocityControl::Input input;
  input.velocity = m_output.reference[1];
  input.acceleration = m_output.reference[2];
  input.measured = m_output.estimatedVelocity = m_alphaBeta.predict(m_spec.filterAhead);
  return m_pid.step(input).force;
}

void vpPrintMachine::fire(const vpPrintMachineInput &seen) noexcept
{
  const double now = seen.time;
  vpPrintTriggerInput input;
  input.time = now;
  input.captureTime = now - m_spec.visionDelay;
  input.cells = seen.cells;
  input.cellCount = seen.cellCount;
  input.epoch = m_epoch;
  input.firstColumn = m_firstColumn - m_spec.cellsPerRow + 1;
  input.lastColumn = m_firstColumn;
  // The sum of displacements, not a filtered position: an error common to all cells cancels exactly, and the lag of a
  // filter would make the cells drift.
  input.captureAlong = m_odometer.output().x;
  input.captureAcross = m_odometer.output().y;
  const vpObservedMotion across = m_observerY.at(now);
  input.across.time = input.along.time = now;
  input.across.position = across.position;
  input.across.velocity = across.velocity;
  if (isObserved()) {
    const vpObservedMotion motion = m_observer.at(now);
    input.along.position = motion.position;
    input.along.velocity = motion.velocity;
    input.along.plan = m_reference.pieces();
    input.along.pieces = m_reference.pieceCount();
  }
  else {
    const vpMotionEstimate motion = m_kalman.at(now);
    const bool asThesis = m_spec.trigger == vpPrintTriggerMethod::ThesisAlgorithm;
    input.along.position = motion.position;
    input.along.velocity = asThesis ? m_output.estimatedVelocity : motion.velocity;
    input.along.acceleration = motion.acceleration;
    input.along.accelerationTime = 1.;
  }
  m_output.trigger = &m_trigger.step(input);
}

void vpPrintMachine::drive(double now) noexcept
{
  for (int i = 0; i < m_spec.commandsPerFrame; ++i) {
    const double t = now + static_cast<double>(i) / m_spec.commandsPerFrame;
    const auto k = static_cast<std::size_t>(i);
    if (isObserved()) {
      m_output.forceX[k] = previewForce(m_preview, t, m_observer, m_reference);
    }
    m_output.forceY[k] = previewForce(m_previewAcross, t, m_observerY, m_referenceY);
    m_observer.command(t, m_output.forceX[k]);
    m_observerY.command(t, m_output.forceY[k]);
  }
}

END_VISP_NAMESPACE
