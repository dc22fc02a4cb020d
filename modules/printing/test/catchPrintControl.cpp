/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// PID with feedforward, its bounds; observer and preview on an independently integrated plant.
#include "vpCatch.h"

#include <visp3/printing/vpMotionObserver.h>
#include <visp3/printing/vpPreviewControl.h>
#include <visp3/printing/vpPrintVelocityControl.h>

#include <algorithm>
#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using vpTestSupport::uniform;

//! Plant by 400 Euler steps per unit of time, moving forward only.
struct Plant {
  vpFrictionModel model;
  double lag = 0.3, disturbance = 0.;
  double p = 0., v = 0., f = 0., t = 0.;
  void run(double command, double duration)
  {
    const int n = static_cast<int>(std::ceil(duration * 400.));
    const double h = duration / n;
    for (int i = 0; i < n; ++i) {
      f += lag > 0. ? h * (command - f) / lag : command - f;
      const double a = (f - disturbance - model.friction(v)) / model.mass;
      p += h * (v + 0.5 * h * a);
      v += h * a;
    }
    t += duration;
  }
};

vpFrictionModel stage()
{
  vpFrictionModel model;
  model.viscous = 0.02;
  model.coulomb = 0.08;
  model.stiction = 0.12;
  model.stribeckVelocity = 0.3;
  return model;
}
} // namespace

TEST_CASE("The PID is the formula, the feedforward is (7.26)", "[control]")
{
  auto rng = vpTestSupport::generator(50);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 1000; ++problem) {
    vpPrintVelocityControlSpec spec = vpPrintVelocityControlSpec::thesisFeedforward();
    spec.feedforward = problem % 2 == 0;
    vpPrintVelocityControl control(spec);
    double sum = 0., before = 0.;
    for (int k = 0; k < 20; ++k) {
      const vpPrintVelocityControl::Input input{uniform(rng, -5., 5.), uniform(rng, -1., 1.), uniform(rng, -5., 5.)};
      const double e = input.velocity - input.measured;
      sum += e;
      double expected = spec.kp * e + spec.ki * sum + spec.kd * (e - before);
      before = e;
      if (spec.feedforward) {
        expected += input.acceleration + 0.02 * input.velocity + (input.velocity > 0. ? 0.08 : -0.08);
      }
      REQUIRE(control.step(input).force == Approx(expected).margin(1e-12));
    }
    control.reset();
    REQUIRE(control.step({}).force == 0.);
  }
}

TEST_CASE("At its bound the integral does not wind up", "[control]")
{
  vpPrintVelocityControlSpec spec;
  spec.kp = 0.1;
  spec.ki = 0.05;
  spec.maxForce = 0.5;
  vpPrintVelocityControl control(spec);
  for (int k = 0; k < 1000; ++k) {
    const auto out = control.step({20., 0., 0.});
    CHECK(out.force == 0.5);
    CHECK(out.saturated);
  }
  CHECK(control.integral() < 10.);
  CHECK(control.step({0., 0., 5.}).force < 0.5); // leaves the bound at once
  const double stands = control.step({0., 0., NAN}).force;
  CHECK(std::isfinite(stands));
}

TEST_CASE("The observer follows the plant through delay and noise and finds the friction error", "[observer]")
{
  auto rng = vpTestSupport::generator(51);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal(0., 1.);
  double nees = 0.;
  int count = 0;
  for (int problem = 0; problem < 60; ++problem) {
    vpMotionObserverSpec spec;
    spec.model = stage();
    spec.delay = problem % 3 == 0 ? 0.7 : 0.;
    spec.disturbanceNoise = 1e-9;
    spec.sigmaDisturbance = 0.02;
    spec.velocityNoise = 1e-9;
    vpMotionObserver observer(spec);
    Plant plant;
    plant.model = stage();
    plant.disturbance = std::max(-0.04, std::min(0.04, 0.02 * normal(rng)));
    const double sigma = problem % 2 == 0 ? 0.13 : 0.005;
    double command = 0.3, old = 0.;
    for (int k = 0; k < 150; ++k) {
      const double now = k;
      old = command;
      command = 0.25 + 0.1 * std::sin(0.3 * k) + 0.02 * normal(rng);
      observer.command(now, command);
      // A command acts after its dead time.
      plant.run(spec.delay > 0. ? (k == 0 ? 0. : old) : command, spec.delay > 0. ? spec.delay : 0.28);
      const double measuredAt = plant.t, measured = plant.p + sigma * normal(rng);
      observer.measure(measuredAt, measured, sigma);
      plant.run(command, 1. - (spec.delay > 0. ? spec.delay : 0.28));
    }
    const vpObservedMotion now = observer.at(150.);
    CHECK(now.position == Approx(plant.p).margin(6. * now.sigmaPosition + 0.02));
    CHECK(now.velocity == Approx(plant.v).margin(6. * now.sigmaVelocity + 0.01));
    CHECK(now.disturbance == Approx(plant.disturbance).margin(0.012));
    nees += std::pow((now.velocity - plant.v) / std::hypot(now.sigmaVelocity, 0.002), 2);
    ++count;
    // And predicted, with the last command held.
    plant.run(command, 2.);
    CHECK(observer.at(152.).velocity == Approx(plant.v).margin(6. * now.sigmaVelocity + 0.02));
  }
  CHECK(nees / count < 2.);
}

TEST_CASE("Without a model error the observer integrates like the plant", "[observer]")
{
  auto rng = vpTestSupport::generator(52);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 100; ++problem) {
    vpMotionObserverSpec spec;
    spec.model = stage();
    spec.lag = problem % 4 == 0 ? 0. : uniform(rng, 0.1, 1.);
    vpMotionObserver observer(spec);
    Plant plant;
    plant.model = stage();
    plant.lag = spec.lag;
    plant.v = 1e-9;
    for (int k = 0; k < 40; ++k) {
      const double command = uniform(rng, 0.2, 0.6);
      observer.command(k, command);
      plant.run(command, 1.);
    }
    CHECK(observer.at(40.).velocity == Approx(plant.v).margin(0.03));
    CHECK(observer.at(40.).position == Approx(plant.p).epsilon(0.01));
  }
}

TEST_CASE("A change of friction does not lock the observer out", "[observer]")
{
  vpMotionObserverSpec spec;
  spec.model = stage();
  spec.disturbanceNoise = 1e-9;
  vpMotionObserver observer(spec);
  Plant plant;
  plant.model = stage();
  for (int k = 0; k < 200; ++k) {
    plant.disturbance = k < 80 ? 0. : 0.05;
    observer.command(k, 0.25);
    plant.run(0.25, 1.);
    observer.measure(k + 1., plant.p, 0.005);
  }
  CHECK(observer.at(200.).velocity == Approx(plant.v).margin(0.02));
  CHECK(observer.at(200.).disturbance == Approx(0.05).margin(0.005));
}

TEST_CASE("A sudden change of friction is found early, and none where there is none", "[observer]")
{
  auto rng = vpTestSupport::generator(53);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal(0., 1.);
  constexpr int problems = 300, changeAt = 60, frames = 90;
  vpMotionObserverSpec spec;
  spec.model = stage();
  spec.disturbanceNoise = 3e-7;
  spec.velocityNoise = 1e-6;
  vpMotionObserverSpec looking = spec;
  looking.changeRate = 0.003;
  // Squares of the errors of the disturbance: with and without the hypotheses, 12 frames after a change and in
  // quiet runs.
  double found = 0., late = 0., quiet = 0., still = 0., promised = 0.;
  for (int problem = 0; problem < problems; ++problem) {
    const bool changes = problem % 2 == 0;
    const double change = (problem % 4 == 0 ? 1. : -1.) * uniform(rng, 0.025, 0.045);
    vpMotionObserver plain(spec), clever(looking);
    Plant plant;
    plant.model = stage();
    for (int k = 0; k < frames; ++k) {
      plant.disturbance = changes && k >= changeAt ? change : 0.;
      const double command = 0.25 + 0.1 * std::sin(0.6 * k); // faster and slower from cell to cell
      plain.command(k, command);
      clever.command(k, command);
      plant.run(command, 1.);
      const double seen = plant.p + 0.127 * normal(rng);
      plain.measure(k + 1., seen, 0.127);
      clever.measure(k + 1., seen, 0.127);
      const double a = clever.at(k + 1.).disturbance - plant.disturbance;
      const double b = plain.at(k + 1.).disturbance - plant.disturbance;
      if (k == changeAt + 12) {
        (changes ? found : quiet) += 2. * a * a / problems;
        (changes ? late : still) += 2. * b * b / problems;
      }
      if (k == frames - 1 && changes) {
        const vpObservedMotion now = clever.at(k + 1.);
        promised += 2. * std::pow((now.position - plant.p) / now.sigmaPosition, 2) / problems;
      }
    }
  }
  CAPTURE(found, late, quiet, still, promised);
  CHECK(found < 0.15 * late);
  CHECK(found < 0.01 * 0.01);
  // A change is accepted at odds of 50 to 1, so at most 3 of the 150 quiet runs are expected to have a false alarm,
  // with an error of about 0.02; 13 of them would break this. Quiet runs without one have hardly any error.
  CHECK(quiet < 0.006 * 0.006);
  CHECK(promised < 1.6); // its own sigma is valid after a change, too
}

TEST_CASE("The preview makes a lagging plant follow a sine without feedback", "[preview]")
{
  for (const double period : {1., 0.25}) {
    vpPreviewControlSpec spec;
    spec.model = stage();
    spec.velocityGain = 0.;
    spec.lag = 0.3;
    spec.period = period;
    const vpPreviewControl control(spec);
    Plant plant;
    plant.model = stage();
    const double w = 2. * M_PI / 40.;
    const auto reference = [w](double t) -> vpAxisState {
      return {{5. * t - std::cos(w * t) / w, 5. + std::sin(w * t), w * std::cos(w * t), -w * w * std::sin(w * t)}};
    };
    plant.v = reference(0.)[1];
    plant.f = plant.model.force(reference(0.)[1], reference(0.)[2]);
    double worst = 0.;
    for (double t = 0.; t < 120.; t += period) {
      vpPreviewControl::Input input;
      input.reference = reference(control.actsAt(t));
      plant.run(control.command(input).force, period);
      worst = std::max(worst, std::fabs(plant.v - reference(plant.t)[1]));
    }
    CAPTURE(period);
    CHECK(worst < 0.03);
  }
}

TEST_CASE("Controls say what is wrong and do not allocate", "[control]")
{
  vpPrintVelocityControlSpec pid;
  pid.kp = -1.;
  CHECK_THROWS_WITH(vpPrintVelocityControl(pid), Catch::Contains("kp of the velocity control is -1, must be >= 0"));
  vpMotionObserverSpec spec;
  spec.delay = 20.;
  CHECK_THROWS_WITH(vpMotionObserver(spec), Catch::Contains("delay of the motion observer is 20, must be in [0, 16]"));
  spec = vpMotionObserverSpec();
  spec.changeRate = 2.;
  CHECK_THROWS_WITH(vpMotionObserver(spec),
                    Catch::Contains("changeRate of the motion observer is 2, must be in [0, 1]"));
  spec = vpMotionObserverSpec();
  spec.model.mass = 0.;
  CHECK_THROWS_WITH(vpMotionObserver(spec), Catch::Contains("mass of the motion observer is 0, must be > 0"));
  vpPreviewControlSpec preview;
  preview.period = 0.;
  CHECK_THROWS_WITH(vpPreviewControl(preview), Catch::Contains("period of the preview control is 0, must be > 0"));
  vpPrintVelocityControl control;
  spec = vpMotionObserverSpec();
  spec.changeRate = 0.01;
  vpMotionObserver observer(spec);
  const vpPreviewControl ahead;
  CHECK(ahead.command({{{NAN, NAN, 0., 0.}}, {}, 0., 0., 0.}).force == 0.);
  CHECK(observer.measure(NAN, 0., 1.) == vpMotionReadingResult::Invalid);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 300; ++k) {
    observer.command(k, control.step({4., 0., 3.}).force);
    observer.measure(k - 1.28, 0., 0.1);
    static_cast<void>(observer.at(k + 1.));
    static_cast<void>(ahead.command({}));
  }
  CHECK(vpTestSupport::allocationCount() == before);
}
