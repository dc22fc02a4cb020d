/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "sensorTest.h"

#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/rendering/vpProductPattern.h>

#include <algorithm>
#include <cmath>

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
} // namespace printExplore
