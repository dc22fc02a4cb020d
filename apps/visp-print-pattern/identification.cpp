/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "identification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

namespace printPattern
{
namespace
{
constexpr int SWINGS = 12;
constexpr int SWING_FRAMES = 160;   // a tenth of a second
constexpr double STRONGEST = 0.30;  // force, px/frame^2 at mass 1: up to about 8 px/frame
constexpr double WEAKEST = 0.10;    // hardly overcomes static friction
constexpr double FIFTH_CELL = 244.; // px: beyond it the stage has more friction, not covered by a constant model
constexpr int HALF_WINDOW = 6;      // frames; velocity and acceleration from a parabola over 2 n + 1 frames

// A parabola fitted to the positions of a window gives velocity and acceleration. The acceleration is a weighted mean
// over the window; the force is averaged with the same weights, or the mass estimate would be too small.
vpFrictionIdentification identify(const std::vector<double> &force, const std::vector<double> &place)
{
  constexpr int n = HALF_WINDOW;
  std::array<double, 2 * n + 1> second{}, mean{};
  double s2 = 0., s4 = 0.;
  for (int i = -n; i <= n; ++i) {
    s2 += i * i;
    s4 += std::pow(i, 4);
  }
  const double count = 2. * n + 1.;
  for (int i = -n; i <= n; ++i) {
    second[static_cast<std::size_t>(i + n)] = 2. * (i * i - s2 / count) / (s4 - s2 * s2 / count);
  }
  for (int j = -n; j <= n; ++j) { // double sum: effect of an acceleration at j on the later positions
    for (int i = j + 1; i <= n; ++i) {
      mean[static_cast<std::size_t>(j + n)] += second[static_cast<std::size_t>(i + n)] * (i - j);
    }
  }
  std::vector<vpFrictionSample> log;
  for (std::size_t k = n; k + n < place.size(); ++k) {
    vpFrictionSample sample;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const std::size_t at = k + i - n;
      sample.velocity += (static_cast<double>(i) - n) / s2 * place[at];
      sample.acceleration += second[i] * place[at];
      sample.force += mean[i] * force[at];
    }
    log.push_back(sample);
  }
  vpFrictionIdentificationSpec task;
  task.minVelocity = 0.15; // slower samples mix standstill and motion within the window
  return vpIdentifyFriction(log, task);
}
} // namespace

Identification identifyStage(const vpPrintExperimentSpec &spec)
{
  const vpXYStageAxis &axis = spec.stage.x;
  Identification result;
  result.truth.mass = axis.mass;
  result.truth.viscous = axis.viscous;
  result.truth.coulomb = axis.coulomb;
  result.truth.stiction = axis.stiction;
  result.truth.stribeckVelocity = axis.stribeckVelocity;
  result.frames = SWINGS * SWING_FRAMES;

  vpXYStage stage(spec.stage);
  // Start far on the near side, so that the oscillation stays in a region of constant friction.
  stage.reset({{std::min(0., axis.viscousRiseFrom) - 4. * FIFTH_CELL, 0.}});
  std::mt19937_64 random(spec.seed);
  std::normal_distribution<double> normal(0., spec.sensorModel.sigmaX / std::sqrt(spec.sensorModel.effectiveCells));
  std::vector<double> force, place;
  double acting = 0.;
  for (int k = 0; k < result.frames; ++k) {
    const double phase = 2. * M_PI * k / SWING_FRAMES, grown = static_cast<double>(k) / result.frames;
    const double command = (WEAKEST + grown * (STRONGEST - WEAKEST)) * std::sin(phase);
    place.push_back(stage.state().position[0] + normal(random));
    force.push_back(acting);
    stage.step(1., {{command, 0.}});
    acting = stage.state().force[0]; // known if the lag is known
  }
  result.found = identify(force, place);
  return result;
}

void useIdentified(const Identification &identification, vpPrintExperimentSpec &spec)
{
  const vpFrictionStatus status = identification.found.status;
  // A misfit is what overlapping windows give: the parameters hold.
  if (status != vpFrictionStatus::Good && status != vpFrictionStatus::NoStribeck &&
      status != vpFrictionStatus::Misfit) {
    throw std::runtime_error(std::string("--identify: ") + identification.found.message());
  }
  for (vpFrictionModel *model : {&spec.observer.model, &spec.preview.model, &spec.pid.model}) {
    *model = identification.found.model;
  }
}
} // namespace printPattern
