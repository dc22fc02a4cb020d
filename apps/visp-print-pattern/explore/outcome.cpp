/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "outcome.h"

#include "appMain.h"
#include "numberText.h"

#include <visp3/core/vpException.h>
#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/rendering/vpProductPattern.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace printExplore
{
namespace
{
constexpr int learningFrames = 120, frames = 60;
constexpr double learningVelocity = 0.37;     // px/frame, as in the print experiment
constexpr double across = 0.013;              // fraction of the velocity, so that all pixel phases occur
constexpr double leastSigma = 1e-4;           // px
constexpr unsigned int firstNoise = 2000000u; // frame numbers unused by runs

//! \brief Sum and sum of squares.
struct Moments {
  double n = 0., sum = 0., squares = 0.;
  void add(double value)
  {
    n += 1.;
    sum += value;
    squares += value * value;
  }
  [[nodiscard]] double deviation() const
  {
    const double mean = n > 0. ? sum / n : 0.;
    return n > 1. ? std::sqrt(std::max(0., squares / n - mean * mean)) : 0.;
  }
};

//! \brief Errors of cells and of their mean over a frame; a constant bias has no effect.
struct Errors {
  Moments x, y, meanX;

  void add(const vpPatternFrame &seen, const std::vector<vpPatternTruthCell> &truth, double pitchX, double pitchY)
  {
    double sum = 0., n = 0.;
    for (const vpPatternCell &cell : seen.cells) {
      const auto nearest = std::min_element(truth.begin(), truth.end(), [&](const auto &a, const auto &b) {
        return std::hypot(a.x - cell.x, a.y - cell.y) < std::hypot(b.x - cell.x, b.y - cell.y);
      });
      if (!cell.valid || nearest == truth.end() || std::fabs(nearest->x - cell.x) > 0.5 * pitchX ||
          std::fabs(nearest->y - cell.y) > 0.5 * pitchY) {
        continue;
      }
      x.add(cell.x - nearest->x);
      y.add(cell.y - nearest->y);
      sum += cell.x - nearest->x;
      n += 1.;
    }
    if (n > 0.) {
      meanX.add(sum / n);
    }
  }
};

//! A different number for each design and run, for any seeds (splitmix64).
unsigned int seedOf(unsigned int seed, std::size_t index, int run)
{
  std::uint64_t z = (static_cast<std::uint64_t>(seed) << 40U) + 64U * index + static_cast<std::uint64_t>(run);
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return static_cast<unsigned int>((z ^ (z >> 31U)) >> 33U);
}

//! Drops of the counted cells: columns -1, -2 ... in printing order.
void takeRun(Outcome &outcome, const vpPrintRun &run, int cells, std::vector<double> &errors)
{
  std::vector<int> drops(static_cast<std::size_t>(cells), 0);
  double first = 0., last = 0.;
  for (const vpPrintDrop &drop : run.drops) {
    const int k = -1 - drop.column;
    if (drop.row == 0 && k >= 0 && k < cells) {
      ++drops[static_cast<std::size_t>(k)];
      errors.push_back(std::hypot(drop.errorX, drop.errorY));
      first = k == 0 ? drop.landTime : first;
      last = k == cells - 1 ? drop.landTime : last;
    }
  }
  outcome.cells += cells;
  outcome.missed += static_cast<int>(std::count(drops.begin(), drops.end(), 0));
  outcome.doubled += static_cast<int>(std::count_if(drops.begin(), drops.end(), [](int n) { return n > 1; }));
  outcome.throughput += last > first ? (cells - 1.) / (last - first) * run.spec.frameRate : 0.;
}

void judge(Outcome &outcome, std::vector<double> &errors, int runs)
{
  outcome.throughput /= runs;
  std::sort(errors.begin(), errors.end());
  double squares = 0.;
  for (const double error : errors) {
    squares += error * error;
  }
  if (!errors.empty()) {
    const double n = static_cast<double>(errors.size());
    outcome.landingRms = std::sqrt(squares / n);
    outcome.landing95 = errors[static_cast<std::size_t>(std::ceil(0.95 * (n - 1.)))];
    outcome.landingWorst = errors.back();
  }
  if (outcome.missed > 0 || outcome.doubled > 0) {
    outcome.verdict = {"cells", "of " + std::to_string(outcome.cells) + " cells " + std::to_string(outcome.missed) +
                                    " got no drop in time and " + std::to_string(outcome.doubled) + " more than one"};
  }
}

void simulate(Outcome &outcome, std::size_t index, const Setup &setup, bool (*goOn)())
{
  const Design &design = outcome.design;
  vpProductPatternSpec product = productOf(design, setup, outcome.timing);
  product.seed = seedOf(setup.seed, index, 0);
  const double velocity = design.dropVelocity * 1e3 / (design.pixelSize * design.frameRate);
  const SensorTest sensor = testSensor(product, velocity);
  outcome.sensorX = sensor.model.sigmaX * design.pixelSize;
  outcome.sensorY = sensor.model.sigmaY * design.pixelSize;
  if (!sensor.good()) {
    outcome.verdict = {"tracker", "the tracker holds the product in " + vpApp::number(100. * sensor.held, 2) +
                                      " % of the frames, with " + vpApp::number(sensor.cells, 2) +
                                      " measured cells on average"};
    return;
  }
  std::vector<double> errors;
  for (int k = 1; k <= setup.task.runs; ++k) {
    vpPrintExperimentSpec spec = experimentOf(design, setup, outcome.timing, sensor.model);
    spec.seed = spec.product.seed = seedOf(setup.seed, index, k);
    takeRun(outcome, runPrintExperiment(spec, [&](double) { return goOn(); }), setup.task.cells, errors);
  }
  judge(outcome, errors, setup.task.runs);
}
} // namespace

SensorTest testSensor(const vpProductPatternSpec &spec, double velocity)
{
  const vpProductPattern product(spec);
  vpPatternTracker tracker(spec.width, spec.height);
  vpImage<unsigned char> image;
  unsigned int number = firstNoise;
  for (int k = learningFrames; k > 0; --k) {
    const double place = -learningVelocity * k;
    product.render(place, place, learningVelocity, learningVelocity, number++, image);
    static_cast<void>(tracker.process(image));
  }
  Errors errors;
  double held = 0.;
  // The velocity grows from frame to frame, by at most half of the tracker's range.
  const double gain = std::min(1., 20. / frames);
  double place = 0., v = 0.;
  for (int k = 0; k < frames; ++k) {
    v += gain * (velocity - v);
    place += v;
    product.render(place, across * place, v, across * v, number++, image);
    const vpPatternFrame &seen = tracker.process(image);
    const bool locked = seen.status == vpPatternStatus::Tracking || seen.status == vpPatternStatus::Degraded;
    if (!locked || seen.validCells == 0) {
      continue;
    }
    held += 1.;
    errors.add(seen, product.cells(place, across * place), spec.pitchX, spec.pitchY);
  }
  SensorTest test;
  test.held = held / frames;
  test.cells = errors.x.n / frames;
  test.model.sigmaX = std::max(leastSigma, errors.x.deviation());
  test.model.sigmaY = std::max(leastSigma, errors.y.deviation());
  const double ofMean = std::max(leastSigma, errors.meanX.deviation());
  test.model.effectiveCells = std::clamp(std::pow(test.model.sigmaX / ofMean, 2), 1., std::max(1., test.cells));
  return test;
}

const std::vector<Figure> &figures()
{
  static const std::vector<Figure> all = {
      {"landing_rms_um", "landing error, rms (um)", false, [](const Outcome &o) { return o.landingRms; }},
      {"landing_p95_um", "landing error, 95 % (um)", false, [](const Outcome &o) { return o.landing95; }},
      {"landing_worst_um", "landing error, worst (um)", false, [](const Outcome &o) { return o.landingWorst; }},
      {"throughput_cells_per_s", "throughput (cells/s)", true, [](const Outcome &o) { return o.throughput; }},
      {"load", "computing load (share of a core)", false, [](const Outcome &o) { return o.timing.load; }},
      {"data_rate_mb_s", "data rate (MB/s)", false, [](const Outcome &o) { return o.timing.dataRate; }},
      {"delay_us", "delay of the camera (us)", false, [](const Outcome &o) { return o.timing.delay; }},
      {"drop_velocity_mm_s", "velocity at the drops (mm/s)", false,
       [](const Outcome &o) { return o.design.dropVelocity; }},
      {"frame_rate_hz", "frame rate (Hz)", true, [](const Outcome &o) { return o.design.frameRate; }}};
  return all;
}

const Figure &figureCalled(const std::string &name)
{
  for (const Figure &figure : figures()) {
    if (name == figure.name) {
      return figure;
    }
  }
  throw std::out_of_range(name);
}

void Outcome::describe(const Design &which, const Setup &setup)
{
  design = which;
  thesis = design == Design::thesis(design.controller);
  timing = timingOf(design, setup);
}

Outcome evaluate(const Design &design, std::size_t index, const Setup &setup, bool (*goOn)())
{
  Outcome outcome;
  outcome.describe(design, setup);
  outcome.verdict = checkTiming(design, setup, outcome.timing);
  if (outcome.verdict.feasible()) {
    try {
      simulate(outcome, index, setup, goOn);
    }
    catch (const vpException &error) { // a length or gain rejected by the modules
      outcome.verdict = {"model", vpApp::sentenceOf(error)};
    }
  }
  return outcome;
}
} // namespace printExplore
