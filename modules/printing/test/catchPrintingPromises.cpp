/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Guarantees in the docstrings of this module under random input: motions that jump, reverse and stand still,
// references and measurements unrelated to each other.
#include "vpCatch.h"

#include <visp3/printing/vpPrintTrigger.h>
#include <visp3/printing/vpPrintVelocityControl.h>

#include <cstdlib>
#include <map>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using vpTestSupport::uniform;
} // namespace

TEST_CASE(
    "Whatever the product does, no cell is fired at twice, and one that passes while it waits is fired at or reported",
    "[trigger]")
{
  auto rng = vpTestSupport::generator(900);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal(0., 1.);
  long fired = 0, missed = 0;
  for (int problem = 0; problem < vpTestSupport::longer(300); ++problem) {
    vpPrintTriggerSpec spec;
    spec.lead = uniform(rng, 0., 1.) < 0.5 ? 0. : uniform(rng, 0., 3.);
    spec.tolerance = uniform(rng, 0., 5.);
    spec.travelTime = uniform(rng, 0., 2.);
    vpPrintTrigger trigger(spec);
    const double noise = uniform(rng, 0., 1.) < 0.5 ? 0.02 : 2.;
    constexpr int cells = 8;
    std::map<int, int> answers;            // for each column
    std::vector<double> ahead(cells, 0.);  // of the nozzle, when a drop fired now lands
    std::vector<bool> waits(cells, false); // and the product moves towards it
    double position = 0., velocity = uniform(rng, -8., 8.);
    for (int k = 0; k < 120; ++k) {
      if (uniform(rng, 0., 1.) < 0.05) {
        velocity = uniform(rng, 0., 1.) < 0.2 ? 0. : uniform(rng, -8., 8.); // without any forecast of it
      }
      if (uniform(rng, 0., 1.) < 0.02) {
        position += uniform(rng, -60., 60.); // a slip
      }
      std::vector<vpPatternCell> seen;
      for (int c = 0; c < cells; ++c) {
        vpPatternCell cell;
        cell.column = c;
        cell.x = 79.5 + 40. * (c - 4) + position + noise * normal(rng);
        cell.y = 49.5;
        cell.sigmaX = cell.sigmaY = 0.05 + noise;
        cell.valid = true;
        if (cell.x > 0. && cell.x < 160.) {
          seen.push_back(cell);
        }
      }
      vpPrintTriggerInput input;
      input.time = input.captureTime = input.along.time = k;
      input.captureAlong = input.along.position = position;
      input.along.velocity = velocity + 0.3 * noise * normal(rng);
      input.cells = seen.data();
      input.cellCount = uniform(rng, 0., 1.) < 0.1 ? 0 : seen.size();
      const vpPrintTriggerOutput &out = trigger.step(input);
      REQUIRE(out.status == vpPrintTriggerStatus::Good);
      CAPTURE(problem, k, position, velocity);
      for (int i = 0; i < out.shotCount + out.missedCount; ++i) {
        const bool shot = i < out.shotCount;
        const vpPrintShot &s =
            shot ? out.shots[static_cast<std::size_t>(i)] : out.missed[static_cast<std::size_t>(i - out.shotCount)];
        REQUIRE(++answers[s.column] == 1);
        if (shot) {
          REQUIRE(s.fireTime >= input.time);
          REQUIRE(s.fireTime <= input.time + spec.period + spec.lead + 1e-9);
          REQUIRE(std::fabs(s.offset) <= spec.tolerance);
        }
        ++(shot ? fired : missed);
      }
      // The trigger's own cell positions determine which have passed since the last step.
      const double lands = input.along.at(input.time + spec.travelTime)[0];
      for (int c = 0; c < cells; ++c) {
        double along = 0., across = 0.;
        if (!trigger.find(0, c, 0, along, across)) {
          continue;
        }
        const std::size_t i = static_cast<std::size_t>(c);
        const double now = along + lands - spec.nozzle;
        if (waits[i] && now * ahead[i] < 0.) {
          REQUIRE(answers[c] == 1);
        }
        waits[i] = now * input.along.velocity < 0. && std::fabs(input.along.velocity) > 1e-6;
        ahead[i] = now;
      }
      position += velocity;
    }
  }
  CHECK(fired > 100);
  CHECK(missed > 10);
}

TEST_CASE("The velocity control's command is bounded, and at the bound its integral does not press on", "[control]")
{
  auto rng = vpTestSupport::generator(901);
  CAPTURE(vpTestSupport::seed());
  int saturated = 0;
  for (int problem = 0; problem < vpTestSupport::longer(200); ++problem) {
    vpPrintVelocityControlSpec spec;
    spec.kp = uniform(rng, 0., 1.);
    spec.ki = uniform(rng, 0., 0.2);
    spec.kd = uniform(rng, 0., 0.5);
    spec.feedforward = problem % 2 == 0;
    spec.model.coulomb = 0.1;
    spec.maxForce = uniform(rng, 0.05, 2.);
    vpPrintVelocityControl control(spec);
    for (int k = 0; k < 200; ++k) {
      const double before = control.integral();
      const auto out = control.step({uniform(rng, -5., 5.), uniform(rng, -1., 1.), uniform(rng, -5., 5.)});
      REQUIRE(std::fabs(out.force) <= spec.maxForce);
      if (out.saturated) {
        ++saturated;
        REQUIRE((control.integral() - before) * out.force <= 0.);
      }
    }
  }
  CHECK(saturated > 1000);
}
