/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/printing/vpPrintExperiment.h"

#include "lab/printing/vpPrintCellSensor.h"

#include <visp3/simulation/vpXYStage.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
//! \brief True motion, stored for exposures and landings.
class Truth
{
public:
  //! \brief State at a time.
  struct Point {
    double t, x, y, vx, vy;
  };
  Truth(const vpXYStageSpec &spec, int parts) : m_parts(parts), m_stage(spec) { remember(); }
  void step(double fx, double fy, int share)
  {
    for (int i = 0; i < m_parts / share; ++i) {
      m_stage.step(1. / m_parts, {{fx, fy}});
      remember();
    }
  }
  [[nodiscard]] double now() const { return m_points.back().t; }
  [[nodiscard]] const Point &last() const { return m_points.back(); }
  //! State at time \e t, cubic interpolation; at rest before the start.
  [[nodiscard]] Point at(double t) const
  {
    if (t <= 0.) {
      return {t, m_points[0].x, m_points[0].y, 0., 0.};
    }
    const auto i = std::min(static_cast<std::size_t>(t * m_parts), m_points.size() - 2);
    const Point &a = m_points[i], &b = m_points[i + 1];
    const double h = b.t - a.t, s = (t - a.t) / h;
    const auto cubic = [&](double p, double v, double q, double w) {
      const double d = q - p, c = 3. * d - h * (2. * v + w), e = -2. * d + h * (v + w);
      return p + s * (h * v + s * (c + s * e));
    };
    return {t, cubic(a.x, a.vx, b.x, b.vx), cubic(a.y, a.vy, b.y, b.vy), a.vx + s * (b.vx - a.vx),
            a.vy + s * (b.vy - a.vy)};
  }

private:
  void remember()
  {
    const vpXYStage::State &s = m_stage.state();
    m_points.push_back(
        {static_cast<double>(m_points.size()) / m_parts, s.position[0], s.position[1], s.velocity[0], s.velocity[1]});
  }
  int m_parts; // in a frame
  vpXYStage m_stage;
  std::vector<Point> m_points;
};

//! \brief Passage of a cell at the nozzle.
struct Pass {
  int row, column;
  double time;     //!< Time, frames.
  double velocity; //!< Velocity in the printing direction, px/frame.
  double x;        //!< True position of the cell at displacement 0, px.
};

void evaluateVelocities(vpPrintRun &run, const std::vector<Pass> &passes)
{
  const vpPrintExperimentSpec &spec = run.spec;
  vpPrintMetrics &m = run.metrics;
  double measured = 0., truth = 0.;
  int count = 0;
  for (std::size_t i = std::max<std::size_t>(1, static_cast<std::size_t>(spec.evaluateFrom)); i < run.samples.size();
       ++i) {
    const vpPrintSample &s = run.samples[i];
    measured += std::pow(s.measuredVelocity - run.samples[i - 1].referenceVelocity, 2);
    truth += std::pow(s.vx - s.referenceVelocity, 2);
    ++count;
  }
  m.rms_velocity_error = std::sqrt(measured / std::max(1, count));
  m.rms_true_velocity_error = std::sqrt(truth / std::max(1, count));
  double centre = 0.;
  count = 0;
  for (const Pass &pass : passes) {
    if (pass.time >= spec.evaluateFrom) {
      const double error = std::fabs(pass.velocity - spec.dropVelocity);
      centre += error * error;
      m.centre_velocity_mean += pass.velocity;
      m.centre_velocity_worst = std::max(m.centre_velocity_worst, error);
      ++count;
    }
  }
  m.centre_velocity_error = std::sqrt(centre / std::max(1, count));
  m.centre_velocity_mean /= std::max(1, count);
}

void evaluateDrops(vpPrintRun &run, const std::vector<Pass> &passes, double end)
{
  const vpPrintExperimentSpec &spec = run.spec;
  vpPrintMetrics &m = run.metrics;
  std::sort(run.drops.begin(), run.drops.end(),
            [](const vpPrintDrop &a, const vpPrintDrop &b) { return a.landTime < b.landTime; });
  std::map<std::pair<int, int>, int> drops;
  double sum = 0.;
  int within = 0;
  for (const vpPrintDrop &drop : run.drops) {
    const double distance = std::hypot(drop.errorX, drop.errorY);
    sum += distance * distance;
    m.landing_worst_um = std::max(m.landing_worst_um, distance);
    within += distance <= 10. ? 1 : 0;
    ++drops[{drop.row, drop.column}];
  }
  const double n = static_cast<double>(run.drops.size());
  m.landing_rms_um = n > 0. ? std::sqrt(sum / n) : 0.;
  m.landed_within_10um = n > 0. ? within / n : 0.;
  for (const auto &cell : drops) {
    ++m.printed;
    m.doubled += cell.second > 1 ? 1 : 0;
  }
  // The drop of a cell that passed in the last frames may still be pending.
  for (const Pass &pass : passes) {
    const bool over = pass.time + 4. + spec.travelTime + spec.electronicsDelay <= end;
    m.missed += over && drops.count({pass.row, pass.column}) == 0 ? 1 : 0;
  }
  if (run.drops.size() > 1) {
    const double time = run.drops.back().landTime - run.drops.front().landTime;
    m.throughput_cells_per_s = (n - 1.) / time * spec.frameRate;
  }
  double constant = 0., taken = 0.;
  for (std::size_t i = 1; i < passes.size(); ++i) {
    if (passes[i].row == passes[i - 1].row) {
      const double way = passes[i].x - passes[i - 1].x;
      constant += std::fabs(way) / spec.dropVelocity;
      taken += passes[i].time - passes[i - 1].time;
    }
  }
  m.gain_over_constant = taken > 0. ? constant / taken - 1. : 0.;
}

/*!
 * Computes the metrics of \e run, and sorts its drops by landing time.
 * \param passes : Passages in printing order.
 * \param end : End time of the run, frames.
 */
void evaluate(vpPrintRun &run, const std::vector<Pass> &passes, double end)
{
  run.metrics.frames = static_cast<int>(run.samples.size());
  run.metrics.complete = static_cast<long>(passes.size()) == static_cast<long>(run.spec.rows) * run.spec.cellsPerRow;
  evaluateVelocities(run, passes);
  evaluateDrops(run, passes, end);
}

constexpr double longestTurn = 0.25;  // s that a row may take in addition to its cells
constexpr double landedWithin = 10.;  // um: a late drop is still fired if it lands within this
constexpr double rowOfNozzle = 0.225; // pitches across: a row passes the nozzle if it is nearer

vpPrintMachineSpec machineOf(const vpPrintExperimentSpec &spec)
{
  const double centreX = 0.5 * (spec.product.width - 1.);
  vpPrintMachineSpec machine = spec;
  machine.pitchX = spec.product.pitchX;
  machine.pitchY = spec.product.pitchY;
  machine.originX = centreX - spec.product.pitchX;
  machine.nozzle = centreX + spec.nozzleOffset;
  machine.nozzleAcross = 0.5 * (spec.product.height - 1.);
  machine.lateTolerance = landedWithin / spec.product.pixelSize;
  machine.sigmaX = spec.sensorModel.sigmaX / std::sqrt(spec.sensorModel.effectiveCells);
  machine.sigmaY = spec.sensorModel.sigmaY / std::sqrt(spec.sensorModel.effectiveCells);
  return machine;
}

//! \brief A machine on a simulated product and stage, in progress.
class Experiment
{
public:
  explicit Experiment(const vpPrintExperimentSpec &spec)
    : m_spec(spec), m_product(spec.product), m_sensor(spec, m_product), m_truth(spec.stage, spec.stageParts),
      m_machine(machineOf(spec))
  {
    m_run.spec = m_spec;
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
    evaluate(m_run, m_passes, m_truth.now());
    return std::move(m_run);
  }

private:
  [[nodiscard]] const vpPrintMachineSpec &nozzle() const { return m_machine.spec(); }
  [[nodiscard]] static int direction(int row) { return row % 2 == 0 ? 1 : -1; }

  //! True position of a cell at displacement 0, from the product with the cell at the image centre.
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

  void step(int frame)
  {
    vpPrintSample sample;
    sample.frame = frame;
    sense(frame, sample);
    vpPrintMachineInput input;
    input.time = frame;
    input.epoch = m_sensor.epoch();
    if (!sample.dropped) {
      input.cells = m_sensor.cells().data();
      input.cellCount = m_sensor.cells().size();
    }
    const vpPrintMachineOutput &out = m_machine.step(input);
    m_flying.insert(m_flying.end(), out.trigger->shots.begin(), out.trigger->shots.begin() + out.trigger->shotCount);
    log(out, sample);
    for (std::size_t i = 0; i < static_cast<std::size_t>(out.commandCount); ++i) {
      m_truth.step(out.forceX[i], out.forceY[i], out.commandCount);
    }
    land();
    pass();
  }

  // Takes an image; some are lost at random.
  void sense(int frame, vpPrintSample &sample)
  {
    std::mt19937_64 &random = m_sensor.random();
    const double exposure = frame - m_spec.visionDelay + m_spec.captureJitter * m_normal(random);
    sample.dropped = std::uniform_real_distribution<double>(0., 1.)(random) < m_spec.dropped && frame > 2;
    if (!sample.dropped) {
      const Truth::Point truth = m_truth.at(std::min(exposure, m_truth.now()));
      m_sensor.see(truth.x, truth.y, truth.vx, truth.vy, static_cast<unsigned int>(frame));
      sample.cells = static_cast<int>(m_sensor.cells().size());
    }
  }

  void log(const vpPrintMachineOutput &out, vpPrintSample &sample)
  {
    const Truth::Point truth = m_truth.last();
    sample.x = truth.x;
    sample.y = truth.y;
    sample.vx = truth.vx;
    sample.vy = truth.vy;
    sample.referencePosition = out.reference[0];
    sample.referenceVelocity = out.reference[1];
    sample.measuredVelocity = out.measuredVelocity;
    sample.estimatedVelocity = out.estimatedVelocity;
    sample.force = out.forceX[0];
    sample.row = out.row;
    m_run.samples.push_back(sample);
  }

  // Evaluates drops that have landed by now.
  void land()
  {
    for (std::size_t i = 0; i < m_flying.size();) {
      const vpPrintShot &shot = m_flying[i];
      const double landing = shot.fireTime + m_spec.electronicsDelay + m_spec.travelTime;
      if (landing > m_truth.now()) {
        ++i;
        continue;
      }
      const Truth::Point truth = m_truth.at(landing);
      const vpPatternTruthCell cell = truthOf(shot.row, shot.column);
      vpPrintDrop drop;
      drop.row = shot.row;
      drop.column = shot.column;
      drop.fireTime = shot.fireTime;
      drop.landTime = landing;
      drop.errorX = (nozzle().nozzle - cell.x - truth.x) * m_spec.product.pixelSize;
      drop.errorY = (nozzle().nozzleAcross - cell.y - truth.y) * m_spec.product.pixelSize;
      drop.velocity = truth.vx;
      drop.late = shot.late;
      m_run.drops.push_back(drop);
      m_flying.erase(m_flying.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  // Cells that pass the nozzle.
  void pass()
  {
    const Truth::Point before = m_truth.at(m_truth.now() - 1.), after = m_truth.last();
    while (m_passing < static_cast<long>(m_spec.rows) * m_spec.cellsPerRow) {
      const int row = static_cast<int>(m_passing / m_spec.cellsPerRow);
      const int column = m_machine.columnOf(row, static_cast<int>(m_passing % m_spec.cellsPerRow));
      const vpPatternTruthCell cell = truthOf(row, column);
      const double place = nozzle().nozzle - cell.x;
      if (direction(row) * (after.x - place) < 0. ||
          std::fabs(before.y + cell.y - nozzle().nozzleAcross) > rowOfNozzle * m_spec.product.pitchY) {
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

  const vpPrintExperimentSpec m_spec;
  vpProductPattern m_product;
  vpPrintCellSensor m_sensor;
  Truth m_truth;
  vpPrintMachine m_machine;
  std::normal_distribution<double> m_normal{0., 1.};
  std::vector<vpPrintShot> m_flying;
  std::vector<Pass> m_passes;
  long m_passing = 0; // cells that have passed, in printing order
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
