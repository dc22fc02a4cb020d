/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/printing/vpPrintExperiment.h"

#include "lab/printing/vpPrintCellSensor.h"
#include "lab/printing/vpPrintEvaluation.h"
#include "lab/printing/vpPrintTruth.h"

#include <algorithm>
#include <cmath>
#include <map>

BEGIN_VISP_NAMESPACE

namespace
{
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
    : m_spec(spec), m_product(spec.product), m_sensor(spec, m_product), m_truth(spec.stage), m_machine(machineOf(spec))
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
    vpEvaluatePrintRun(m_run, m_passes, m_truth.now());
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
      const vpPrintTruth::Point truth = m_truth.at(std::min(exposure, m_truth.now()));
      m_sensor.see(truth.x, truth.y, truth.vx, truth.vy, static_cast<unsigned int>(frame));
      sample.cells = static_cast<int>(m_sensor.cells().size());
    }
  }

  void log(const vpPrintMachineOutput &out, vpPrintSample &sample)
  {
    const vpPrintTruth::Point truth = m_truth.last();
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
      const vpPrintTruth::Point truth = m_truth.at(landing);
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
    const vpPrintTruth::Point before = m_truth.at(m_truth.now() - 1.), after = m_truth.last();
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
  vpPrintTruth m_truth;
  vpPrintMachine m_machine;
  std::normal_distribution<double> m_normal{0., 1.};
  std::vector<vpPrintShot> m_flying;
  std::vector<vpPrintPass> m_passes;
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
