/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpPrintExperiment.h>

#include "vpPrintCellSensor.h"
#include "vpPrintEvaluation.h"
#include "vpPrintTruth.h"

#include <visp3/printing/vpMotionKalmanFilter.h>
#include <visp3/printing/vpProductOdometer.h>

#include <algorithm>
#include <cmath>
#include <map>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double longestTurn = 0.25;  // s that a row may take beyond its cells
constexpr double landedWithin = 10.;  // um: a late drop is still fired if it lands so close
constexpr double rowOfNozzle = 0.225; // pitches across: a row passes the nozzle if it is nearer

//! \brief A run in progress.
class Experiment
{
public:
  explicit Experiment(const vpPrintExperimentSpec &spec)
    : m_spec(spec), m_product(spec.product), m_sensor(spec, m_product), m_truth(spec.stage),
      m_centreX(0.5 * (spec.product.width - 1.)), m_centreY(0.5 * (spec.product.height - 1.)),
      m_nozzle(m_centreX + spec.nozzleOffset), m_trigger(triggerSpec()), m_reference(spec.reference),
      m_referenceY(vpPrintReferenceSpec()), m_pid(spec.pid), m_preview(within(spec.preview)),
      m_previewAcross(within(spec.previewAcross)), m_observer(spec.observer), m_observerY(spec.observer),
      m_alphaBeta(spec.filter), m_kalman(spec.forecast)
  {
    start();
  }

  vpPrintRun run(const std::function<bool(double)> &progress)
  {
    const int total = m_spec.rows * m_spec.cellsPerRow;
    const double slowest = m_spec.product.pitchX / m_spec.dropVelocity;
    const double most = 1.5 * total * slowest + longestTurn * m_spec.frameRate * (m_spec.rows + 1);
    const int limit = m_spec.frames > 0 ? m_spec.frames : static_cast<int>(most);
    for (int frame = 0; frame < limit; ++frame) {
      step(frame);
      if (m_spec.frames == 0 && done()) {
        break;
      }
      if (progress && frame % 64 == 0 && !progress(static_cast<double>(frame) / limit)) {
        break;
      }
    }
    vpEvaluatePrintRun(m_run, m_passes, m_truth.now());
    return std::move(m_run);
  }

private:
  void start()
  {
    m_run.spec = m_spec;
    m_sigmaX = m_spec.sensorModel.sigmaX / std::sqrt(m_spec.sensorModel.effectiveCells);
    m_sigmaY = m_spec.sensorModel.sigmaY / std::sqrt(m_spec.sensorModel.effectiveCells);
    m_kalman.reset(-m_spec.visionDelay);
    m_observer.reset(-m_spec.visionDelay - 1.);
    m_observerY.reset(-m_spec.visionDelay - 1.);
    m_reference.reset(0., 0., -1);
    m_referenceY.reset(0., 0., 0);
  }

  [[nodiscard]] vpPreviewControlSpec within(vpPreviewControlSpec preview) const
  {
    preview.period = 1. / m_spec.commandsPerFrame;
    return preview;
  }

  [[nodiscard]] vpPrintTriggerSpec triggerSpec() const
  {
    vpPrintTriggerSpec trigger;
    trigger.method = m_spec.trigger;
    trigger.nozzle = m_nozzle;
    trigger.nozzleAcross = m_centreY;
    trigger.rowTolerance = 0.4 * m_spec.product.pitchY;
    trigger.travelTime = m_spec.travelTime;
    trigger.electronicsDelay = m_spec.electronicsDelay;
    trigger.tolerance = landedWithin / m_spec.product.pixelSize;
    trigger.drift = m_spec.cellDrift;
    trigger.match = 0.4 * std::min(m_spec.product.pitchX, m_spec.product.pitchY);
    return trigger;
  }

  [[nodiscard]] int direction(int row) const { return row % 2 == 0 ? 1 : -1; }
  //! Column of the k-th cell of a row.
  [[nodiscard]] int columnOf(int row, int k) const { return row % 2 == 0 ? -1 - k : -m_spec.cellsPerRow + k; }
  [[nodiscard]] long keyOf(int row, int k) const { return static_cast<long>(row) * (m_spec.cellsPerRow + 1L) + k; }

  //! True place of a cell at displacement 0. The product tells it when the cell is in the middle of the image.
  vpPatternTruthCell truthOf(int row, int column)
  {
    const auto key = std::make_pair(row, column);
    const auto known = m_truths.find(key);
    if (known != m_truths.end()) {
      return known->second;
    }
    const double x = -column * m_spec.product.pitchX, y = -row * m_spec.product.pitchY;
    vpPatternTruthCell found;
    for (vpPatternTruthCell cell : m_product.cells(x, y)) {
      if (cell.row == row && cell.column == column) {
        cell.x -= x;
        cell.y -= y;
        found = cell;
      }
    }
    m_truths[key] = found;
    return found;
  }

  //! Displacement at which a cell is at the nozzle, as far as it is known: measured, or a pitch from its neighbour.
  double placeOf(int row, int column)
  {
    double along = 0., across = 0.;
    if (m_trigger.find(row, column, m_sensor.epoch(), along, across)) {
      m_lastKnown = {row, column, along};
      return m_nozzle - along;
    }
    if (m_lastKnown.row == row) {
      return m_nozzle - m_lastKnown.along - (column - m_lastKnown.column) * m_spec.product.pitchX;
    }
    return m_nozzle - m_centreX - column * m_spec.product.pitchX;
  }

  // The cells from the present one on, turns between the rows.
  void makeTargets(double now)
  {
    m_targets.clear();
    const long perRow = m_spec.cellsPerRow + 1L;
    const double pitch = m_spec.product.pitchX, turn = 2. * pitch / m_spec.dropVelocity;
    const long begin = std::max(0L, m_present - 1);
    for (long key = begin; key < begin + 5; ++key) {
      const int row = static_cast<int>(key / perRow), k = static_cast<int>(key % perRow);
      if (row >= m_spec.rows) {
        break;
      }
      vpPrintTarget target;
      target.key = key;
      if (k < m_spec.cellsPerRow) {
        target.position = placeOf(row, columnOf(row, k));
        target.velocity = direction(row) * m_spec.dropVelocity;
        target.duration = k == 0 && row > 0 ? turn : 0.;
      }
      else {
        target.position = placeOf(row, columnOf(row, k - 1)) + direction(row) * pitch;
        target.velocity = 0.;
        target.duration = turn;
      }
      m_targets.push_back(target);
    }
    m_row = std::min(static_cast<int>(m_present / perRow), m_spec.rows - 1);
    // Behind the last cell of a row the stage steps to the next one.
    const bool turning = m_present % perRow == m_spec.cellsPerRow;
    const int rowAcross = std::min(turning ? m_row + 1 : m_row, m_spec.rows - 1);
    // The nozzle follows the cells across the rows, too: the next three, as they were measured.
    double sum = 0.;
    int known = 0;
    const int first = turning ? 0 : static_cast<int>(m_present % perRow);
    for (int k = first; k < std::min(first + 3, m_spec.cellsPerRow); ++k) {
      double along = 0., across = 0.;
      if (m_trigger.find(rowAcross, columnOf(rowAcross, k), m_sensor.epoch(), along, across)) {
        sum += m_centreY - across;
        ++known;
      }
    }
    const double regular = -rowAcross * m_spec.product.pitchY;
    m_acrossOffset = known > 0 ? sum / known - regular : m_acrossOffset;
    m_targetY = vpPrintTarget();
    m_targetY.key = m_present + 1;
    m_targetY.position = regular + m_acrossOffset;
    m_targetY.velocity = 0.;
    m_stepArrival = turning && !m_turning ? now + m_spec.rowStepTime : m_stepArrival;
    m_turning = turning;
    m_targetY.duration = std::max(m_stepArrival - now, m_spec.followTime);
  }

  void step(int frame)
  {
    const double now = frame, capture = now - m_spec.visionDelay;
    vpPrintSample sample;
    sample.frame = frame;
    sense(frame, capture, sample);
    makeTargets(now);
    const vpPrintReference::Output &reference = m_reference.step(now, m_targets.data(), m_targets.size());
    m_present = reference.hasTarget ? reference.target : m_present;
    if (!reference.hasTarget && !m_targets.empty() && now > 1.) {
      m_present = m_targets.back().key;
    }
    m_referenceY.step(now, &m_targetY, 1);

    const vpAxisState r = m_reference.at(now);
    const bool observed = m_spec.controller == vpPrintController::Observer;
    sample.estimatedVelocity = m_observer.at(now).velocity;
    const double fx = observed ? previewForce(m_preview, now, m_observer, m_reference) : pidForce(r, sample);
    fire(now, capture, sample);

    const vpPrintTruth::Point truth = m_truth.last();
    sample.x = truth.x;
    sample.y = truth.y;
    sample.vx = truth.vx;
    sample.vy = truth.vy;
    sample.referencePosition = r[0];
    sample.referenceVelocity = r[1];
    sample.force = fx;
    sample.row = m_row;
    m_run.samples.push_back(sample);
    drive(now, fx);
    land();
  }

  void sense(int frame, double capture, vpPrintSample &sample)
  {
    std::mt19937_64 &random = m_sensor.random();
    const double exposure = capture + m_spec.captureJitter * m_normal(random);
    sample.dropped = std::uniform_real_distribution<double>(0., 1.)(random) < m_spec.dropped && frame > 2;
    sample.measuredVelocity = m_run.samples.empty() ? 0. : m_run.samples.back().measuredVelocity;
    m_seen = false;
    if (sample.dropped) {
      return;
    }
    const vpPrintTruth::Point truth = m_truth.at(std::min(exposure, m_truth.now()));
    m_sensor.see(truth.x, truth.y, truth.vx, truth.vy, static_cast<unsigned int>(frame));
    sample.cells = static_cast<int>(m_sensor.cells().size());
    if (m_sensor.cells().empty()) {
      return;
    }
    const double gap = capture - m_lastCapture;
    const vpProductOdometer::Output &moved =
        m_odometer.step(m_sensor.cells().data(), m_sensor.cells().size(), m_sensor.epoch(),
                        positionAt(capture) - positionAt(m_lastCapture), 0.);
    m_seen = true;
    if (moved.measured) {
      sample.measuredVelocity = moved.dx / gap;
    }
    m_lastCapture = capture;
    m_alphaBeta.step(sample.measuredVelocity);
    m_kalman.add({vpMotionReadingKind::Position, capture, moved.x, m_sigmaX});
    m_observer.measure(capture, moved.x, m_sigmaX);
    m_observerY.measure(capture, moved.y, m_sigmaY);
  }

  [[nodiscard]] double positionAt(double t) const
  {
    return m_spec.controller == vpPrintController::Observer ? m_observer.at(t).position : m_kalman.at(t).position;
  }

  double pidForce(const vpAxisState &r, vpPrintSample &sample)
  {
    if (!m_seen) {
      m_alphaBeta.skip();
    }
    vpPrintVelocityControl::Input input;
    input.velocity = r[1];
    input.acceleration = r[2];
    input.measured = m_alphaBeta.predict(m_spec.filterAhead);
    sample.estimatedVelocity = input.measured;
    return m_pid.step(input).force;
  }

  // The commands of a frame.
  void drive(double now, double first)
  {
    const int n = m_spec.commandsPerFrame;
    for (int i = 0; i < n; ++i) {
      const double t = now + static_cast<double>(i) / n;
      const bool observed = m_spec.controller == vpPrintController::Observer;
      const double fx = observed ? previewForce(m_preview, t, m_observer, m_reference) : first;
      const double fy = previewForce(m_previewAcross, t, m_observerY, m_referenceY);
      m_observer.command(t, fx);
      m_observerY.command(t, fy);
      m_truth.step(fx, fy, n);
    }
  }

  static double previewForce(const vpPreviewControl &control, double now, const vpMotionObserver &observer,
                             const vpPrintReference &reference)
  {
    const vpObservedMotion motion = observer.at(control.feedbackAt(now));
    vpPreviewControl::Input input;
    input.reference = reference.at(control.actsAt(now));
    input.referenceFeedback = reference.at(control.feedbackAt(now));
    input.position = motion.position;
    input.velocity = motion.velocity;
    input.disturbance = motion.velocity == 0. && input.reference[1] == 0. ? 0. : motion.disturbance;
    return control.command(input).force;
  }

  void fire(double now, double capture, const vpPrintSample &sample)
  {
    vpPrintTriggerInput input;
    input.time = now;
    input.captureTime = capture;
    if (m_seen) {
      input.cells = m_sensor.cells().data();
      input.cellCount = m_sensor.cells().size();
    }
    input.epoch = m_sensor.epoch();
    input.firstColumn = -m_spec.cellsPerRow;
    input.lastColumn = -1;
    const vpObservedMotion across = m_observerY.at(now);
    // The sum of displacements, not a filtered position: an error that all cells have in common cancels exactly, and
    // the lag of a filter would make the cells wander.
    input.captureAlong = m_odometer.output().x;
    input.captureAcross = m_odometer.output().y;
    input.across.time = now;
    input.across.position = across.position;
    input.across.velocity = across.velocity;
    input.along.time = now;
    if (m_spec.controller == vpPrintController::Observer) {
      const vpObservedMotion motion = m_observer.at(now);
      input.along.position = motion.position;
      input.along.velocity = motion.velocity;
      input.along.plan = m_reference.pieces();
      input.along.pieces = m_reference.pieceCount();
    }
    else {
      const vpMotionEstimate motion = m_kalman.at(now);
      input.along.position = motion.position;
      input.along.velocity = motion.velocity;
      input.along.acceleration = motion.acceleration;
      input.along.accelerationTime = 1.;
      if (m_spec.trigger == vpPrintTriggerMethod::ThesisAlgorithm) {
        input.along.velocity = sample.estimatedVelocity;
      }
    }
    const vpPrintTriggerOutput &out = m_trigger.step(input);
    for (int i = 0; i < out.shotCount; ++i) {
      m_flying.push_back(out.shots[static_cast<std::size_t>(i)]);
    }
  }

  // Drops whose landing is in the past by now.
  void land()
  {
    for (std::size_t i = 0; i < m_flying.size();) {
      const vpPrintShot &shot = m_flying[i];
      const double landing = shot.fireTime + m_spec.electronicsDelay + m_spec.travelTime;
      if (landing > m_truth.now()) {
        ++i;
        continue;
      }
      const vpPrintTruth::Point truth = m_truth.at(landing);
      const vpPatternTruthCell cell = truthOf(shot.row, shot.column);
      vpPrintDrop drop;
      drop.row = shot.row;
      drop.column = shot.column;
      drop.fireTime = shot.fireTime;
      drop.landTime = landing;
      drop.errorX = (m_nozzle - cell.x - truth.x) * m_spec.product.pixelSize;
      drop.errorY = (m_centreY - cell.y - truth.y) * m_spec.product.pixelSize;
      drop.velocity = truth.vx;
      drop.late = shot.late;
      m_run.drops.push_back(drop);
      m_flying.erase(m_flying.begin() + static_cast<std::ptrdiff_t>(i));
    }
    // Cells that pass the nozzle.
    const vpPrintTruth::Point before = m_truth.at(m_truth.now() - 1.), after = m_truth.last();
    while (m_passing < static_cast<long>(m_spec.rows) * m_spec.cellsPerRow) {
      const int row = static_cast<int>(m_passing / m_spec.cellsPerRow);
      const int column = columnOf(row, static_cast<int>(m_passing % m_spec.cellsPerRow));
      const vpPatternTruthCell cell = truthOf(row, column);
      const double place = m_nozzle - cell.x;
      if (direction(row) * (after.x - place) < 0. ||
          std::fabs(before.y + cell.y - m_centreY) > rowOfNozzle * m_spec.product.pitchY) {
        break;
      }
      double low = before.t, high = after.t; // bisection
      for (int i = 0; i < 50; ++i) {
        const double t = 0.5 * (low + high);
        (direction(row) * (m_truth.at(t).x - place) < 0. ? low : high) = t;
      }
      m_passes.push_back({row, column, high, direction(row) * m_truth.at(high).vx, cell.x});
      ++m_passing;
    }
  }

  [[nodiscard]] bool done() const
  {
    return m_passing == static_cast<long>(m_spec.rows) * m_spec.cellsPerRow &&
           m_truth.now() > m_passes.back().time + 4. + m_spec.travelTime + m_spec.electronicsDelay;
  }

  struct Known {
    int row, column;
    double along;
  };

  const vpPrintExperimentSpec m_spec;
  vpProductPattern m_product;
  vpPrintCellSensor m_sensor;
  vpPrintTruth m_truth;
  double m_centreX, m_centreY, m_nozzle;
  vpPrintTrigger m_trigger;
  vpPrintReference m_reference, m_referenceY;
  vpPrintVelocityControl m_pid;
  vpPreviewControl m_preview, m_previewAcross;
  vpMotionObserver m_observer, m_observerY;
  vpAlphaBetaFilter m_alphaBeta;
  vpMotionKalmanFilter m_kalman;
  vpProductOdometer m_odometer;
  std::normal_distribution<double> m_normal{0., 1.};
  double m_sigmaX = 1., m_sigmaY = 1.;
  double m_lastCapture = 0.;
  bool m_seen = false;
  std::vector<vpPrintTarget> m_targets;
  vpPrintTarget m_targetY;
  long m_present = 0; // key of the present target
  int m_row = 0;
  bool m_turning = false;
  double m_stepArrival = 0.;  // when the step to the row ends
  double m_acrossOffset = 0.; // of the rows from their regular place, px
  Known m_lastKnown{-1, 0, 0.};
  std::vector<vpPrintShot> m_flying;
  std::vector<vpPrintPass> m_passes;
  long m_passing = 0; // cells that have passed, in the order of printing
  std::map<std::pair<int, int>, vpPatternTruthCell> m_truths;
  vpPrintRun m_run;
};
} // namespace

vpPrintRun runPrintExperiment(const vpPrintExperimentSpec &spec, const std::function<bool(double)> &progress)
{
  spec.validate();
  return Experiment(spec).run(progress);
}

END_VISP_NAMESPACE
