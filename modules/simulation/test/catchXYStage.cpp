/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A stage against closed forms: friction, lag, delay, sticking, slipping.
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/simulation/vpXYStage.h>

#include <algorithm>
#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace
{
//! No friction at all; mass 2.
vpXYStageSpec free(double lag, double delay)
{
  vpXYStageSpec spec;
  spec.x.mass = spec.y.mass = 2.;
  spec.x.lag = spec.y.lag = lag;
  spec.x.delay = spec.y.delay = delay;
  return spec;
}

//! Velocity that a force keeps, by bisection on the branch where friction rises with the velocity.
double steadyVelocity(const vpXYStageAxis &axis, double force, double position)
{
  double low = 1.5, high = 100.;
  for (int k = 0; k < 100; ++k) {
    const double v = 0.5 * (low + high);
    const double friction = axis.coulomb +
                            (axis.stiction - axis.coulomb) * std::exp(-std::pow(v / axis.stribeckVelocity, 2)) +
                            axis.viscous * (position > axis.viscousRiseFrom ? 1. + axis.viscousRise : 1.) * v;
    (friction < force ? low : high) = v;
  }
  return low;
}

//! \brief Motion of a stage pulled by a spring in the second half of the time.
struct Drawn {
  double restingShare = 0., firstMove = 0., fastest = 0.;
};
Drawn drawBySpring(double stiffness, double velocity, double seconds, double dt)
{
  vpXYStageSpec spec = vpXYStageSpec::thesis();
  spec.x.lag = 0.;
  spec.x.viscousRise = 0.;
  vpXYStage stage(spec);
  Drawn drawn;
  const int steps = static_cast<int>(seconds / dt);
  int resting = 0;
  for (int k = 0; k < steps; ++k) {
    stage.step(dt, {stiffness * (velocity * k * dt - stage.state().position[0]), 0.});
    drawn.firstMove = drawn.firstMove == 0. && !stage.state().resting[0] ? stage.state().time : drawn.firstMove;
    if (k > steps / 2) {
      resting += stage.state().resting[0] ? 1 : 0;
      drawn.fastest = std::max(drawn.fastest, stage.state().velocity[0]);
    }
  }
  drawn.restingShare = resting / (0.5 * steps);
  return drawn;
}
} // namespace

TEST_CASE("Without friction a stage follows the closed form of lag and delay", "[stage]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(0., 1.);
  for (int problem = 0; problem < 200; ++problem) {
    const double lag = problem % 3 == 0 ? 0. : 2. * unit(rng), delay = problem % 2 == 0 ? 0. : 3. * unit(rng);
    const double dt = 0.05 + unit(rng), force = 4. * unit(rng) - 2.;
    vpXYStage stage(free(lag, delay));
    for (int k = 0; k < 12; ++k) {
      stage.step(dt, {force, -0.5 * force});
      const double t = std::max(0., stage.state().time - delay);
      const double grown = lag > 0. ? -std::expm1(-t / lag) : (t > 0. ? 1. : 0.);
      CHECK(stage.state().force[0] == Approx(force * grown).margin(1e-12));
      CHECK(stage.state().velocity[0] == Approx(force / 2. * (t - lag * grown)).margin(1e-12));
      const double place = force / 2. * (t * t / 2. - lag * t + lag * lag * grown);
      CHECK(stage.state().position[0] == Approx(place).margin(1e-3 * std::fabs(force) * dt * dt));
      CHECK(stage.state().velocity[1] == Approx(-0.5 * stage.state().velocity[0]).margin(1e-12));
    }
  }
}

TEST_CASE("The lag has its time constant, the delay cuts a step where it ends", "[stage]")
{
  vpXYStage lagging(vpXYStageSpec::thesis());
  lagging.step(0.3, {0.1, 0.}); // below stiction: it does not move, but the force comes
  CHECK(lagging.state().force[0] == Approx(0.1 * (1. - std::exp(-1.))).epsilon(1e-12));
  CHECK(lagging.state().resting[0]);

  vpXYStage delayed(free(0., 1.28)); // the command acts for 0.72 of the second step
  delayed.step(1., {1., 0.});
  CHECK(delayed.state().velocity[0] == 0.);
  delayed.step(1., {0., 0.});
  CHECK(delayed.state().velocity[0] == Approx(0.5 * 0.72).epsilon(1e-12));
  delayed.step(1., {0., 0.});
  CHECK(delayed.state().velocity[0] == Approx(0.5).epsilon(1e-12));
  delayed.step(1., {0., 0.});
  CHECK(delayed.state().velocity[0] == Approx(0.5).epsilon(1e-12));

  // A delay of many steps; then another command long before the first arrives.
  vpXYStage late(free(0., 10.));
  for (int k = 0; k < 1500; ++k) {
    late.step(0.01, {k < 100 ? 2. : 0., 0.});
  }
  CHECK(late.state().velocity[0] == Approx(1.).epsilon(1e-9));
}

TEST_CASE("A steady force gives the velocity at which friction equals it", "[stage]")
{
  vpXYStageSpec spec = vpXYStageSpec::thesis();
  spec.x.viscousRiseFrom = 1e5;
  for (const double force : {0.13, 0.15, 0.2, 0.35}) {
    for (const double sign : {1., -1.}) {
      vpXYStage stage(spec);
      for (int k = 0; k < 1500; ++k) {
        stage.step(1., {sign * force, 0.});
      }
      CHECK(stage.state().velocity[0] == Approx(sign * steadyVelocity(spec.x, force, 0.)).epsilon(1e-6));
    }
  }
  CHECK(steadyVelocity(spec.x, 0.2, 0.) == Approx(6.).epsilon(1e-3));
  // Beyond the fifth cell the same force gives less.
  vpXYStage stage(vpXYStageSpec::thesis());
  stage.reset({300., 0.});
  for (int k = 0; k < 1000; ++k) {
    stage.step(1., {0.2, 0.});
  }
  CHECK(stage.state().velocity[0] == Approx(steadyVelocity(vpXYStageSpec::thesis().x, 0.2, 300.)).epsilon(1e-6));
  CHECK(stage.state().velocity[0] == Approx(6. / 1.3).epsilon(1e-3));
  // The speed limit is kept.
  spec.x.maxVelocity = 2.5;
  vpXYStage slow(spec);
  for (int k = 0; k < 200; ++k) {
    slow.step(1., {-0.35, 0.});
  }
  CHECK(slow.state().velocity[0] == -2.5);
}

TEST_CASE("Coulomb friction alone stops a stage where the closed form says", "[stage]")
{
  vpXYStageSpec spec;
  spec.x.coulomb = spec.x.stiction = 0.5;
  vpXYStage stage(spec);
  for (int k = 0; k < 10; ++k) {
    stage.step(1., {2.5, 0.}); // v = 20, p = 100
  }
  CHECK(stage.state().velocity[0] == Approx(20.).epsilon(1e-12));
  for (int k = 0; k < 60; ++k) {
    stage.step(0.9, {0., 0.});
  }
  CHECK(stage.state().resting[0]);
  CHECK(stage.state().velocity[0] == 0.);
  CHECK(stage.state().position[0] == Approx(100. + 20. * 20. / (2. * 0.5)).epsilon(1e-10));
  stage.step(1., {-0.5, 0.}); // not above stiction
  CHECK(stage.state().resting[0]);
  stage.step(1., {-0.51, 0.});
  CHECK(stage.state().velocity[0] == Approx(-0.01).epsilon(1e-9));
}

TEST_CASE("Drawn slowly by a soft spring a stage sticks and slips, fast it does not", "[stage]")
{
  const double stiffness = 0.01;
  const Drawn slow = drawBySpring(stiffness, 0.1, 4000., 0.05);
  CAPTURE(slow.restingShare, slow.fastest);
  CHECK(slow.firstMove == Approx(0.12 / stiffness / 0.1).epsilon(0.001)); // when the spring force equals the stiction
  CHECK(slow.restingShare > 0.2);
  CHECK(slow.fastest > 2. * 0.1);
  // Sliding is steady where the friction grows with velocity: below 0.0225, at the flat top of the Stribeck curve, ...
  CHECK(drawBySpring(stiffness, 0.015, 8000., 0.05).restingShare == 0.);
  // ... and far above the Stribeck velocity.
  const Drawn fast = drawBySpring(stiffness, 3., 4000., 0.05);
  CHECK(fast.restingShare == 0.);
  CHECK(fast.fastest == Approx(3.).epsilon(0.01));
}

TEST_CASE("The same commands give the same motion, finer steps nearly so", "[stage]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal(0.1, 0.15);
  vpXYStageSpec spec = vpXYStageSpec::thesis();
  spec.x.delay = 1.28;
  vpXYStage a(spec), b(spec), fine(spec);
  double worst = 0.;
  for (int k = 0; k < 400; ++k) {
    const vpXYStage::Pair command{{normal(rng), normal(rng)}};
    a.step(1., command);
    b.step(1., command);
    for (int i = 0; i < 20; ++i) {
      fine.step(0.05, command);
    }
    REQUIRE(a.state().position == b.state().position);
    REQUIRE(a.state().velocity == b.state().velocity);
    worst = std::max({worst, std::fabs(a.state().velocity[0] - fine.state().velocity[0]),
                      std::fabs(a.state().velocity[1] - fine.state().velocity[1])});
  }
  // It sticks or breaks away up to a part (1/32) late: 1/32 of an acceleration of 0.04 + 0.5 / 0.3 / 32 each time, and several
  // of them add up.
  CHECK(worst < 5 * 2.9e-3);
  a.reset();
  CHECK(a.state().velocity[0] == 0.);
  vpXYStage c(spec);
  a.step(1., {{0.3, 0.}});
  c.step(1., {{0.3, 0.}});
  CHECK(a.state().position == c.state().position); // nothing is left of before
}

TEST_CASE("A step of a stage does not allocate", "[stage]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("this build cannot count allocations");
    return;
  }
  vpXYStageSpec spec = vpXYStageSpec::thesis();
  spec.x.delay = 10.;
  vpXYStage stage(spec);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 5000; ++k) {
    stage.step(0.01, {{0.2, 0.1}});
  }
  CHECK(vpTestSupport::allocationCount() == before);
}

TEST_CASE("A stage refuses what makes no sense", "[stage]")
{
  struct Case {
    void (*spoil)(vpXYStageSpec &);
    std::string sentence;
  };
  const std::vector<Case> cases = {
      {[](auto &s) { s.x.mass = 0.; }, "mass of stage axis x is 0, must be > 0"},
      {[](auto &s) { s.y.viscous = -1.; }, "viscous of stage axis y is -1, must be >= 0"},
      {[](auto &s) { s.x.stiction = 0.01; }, "stiction of stage axis x is 0.01, must be >= coulomb"},
      {[](auto &s) { s.x.coulomb = NAN; }, "coulomb of stage axis x is nan, must be >= 0"},
      {[](auto &s) { s.y.stribeckVelocity = 0.; }, "stribeckVelocity of stage axis y is 0, must be > 0"},
      {[](auto &s) { s.x.lag = INFINITY; }, "lag of stage axis x is inf, must be >= 0"},
      {[](auto &s) { s.x.delay = -1.; }, "delay of stage axis x is -1, must be >= 0"},
      {[](auto &s) { s.y.maxVelocity = 0.; }, "maxVelocity of stage axis y is 0, must be > 0"},
      {[](auto &s) { s.y.viscousRise = -2.; }, "viscousRise of stage axis y is -2, must be >= -1"},
  };
  for (const Case &bad : cases) {
    vpXYStageSpec spec = vpXYStageSpec::thesis();
    bad.spoil(spec);
    CHECK_THROWS_WITH(vpXYStage(spec), Catch::Contains(bad.sentence));
  }
  vpXYStageSpec spec;
  spec.x.delay = 2.;
  vpXYStage stage(spec);
  CHECK_THROWS_WITH(stage.step(0., {{0., 0.}}), Catch::Contains("time step of the stage is 0, must be > 0"));
  CHECK_THROWS_WITH(stage.step(1e-3, {{0., 0.}}), Catch::Contains("time step of the stage is 0.001"));
  CHECK_THROWS_WITH(stage.step(1., {{0., NAN}}), Catch::Contains("command of the stage is nan, must be finite"));
  CHECK_THROWS_WITH(stage.reset({{INFINITY, 0.}}), Catch::Contains("position of the stage is inf"));
  CHECK(stage.state().time == 0.);
}
