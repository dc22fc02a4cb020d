/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The shaper keeps its limits for any input, arrives exactly, and takes away the step at t = 0.
#include "vpTrajectoryTestKit.h"

#include <visp3/core/vpException.h>
#include <visp3/trajectory/vpTwistShaper.h>
#include <visp3/trajectory/vpVelocityRamp.h>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

TEST_CASE("velocity ramps keep their limits, are continuous and arrive", "[shaper]")
{
  auto rng = vpTestSupport::generator(110);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 20000; ++k) {
    const double A = logUniform(rng, 0.1, 10.), J = logUniform(rng, 0.1, 1000.);
    const double v = uniform(rng, -2., 2.), a = uniform(rng, -1.5, 1.5) * A, target = uniform(rng, -2., 2.);
    const vpVelocityRamp ramp(v, a, target, A, J);
    const double T = ramp.duration();
    CAPTURE(v, a, target, A, J, T);
    REQUIRE(ramp.count() <= 4);
    double t = 0.;
    for (int i = 0; i < ramp.count(); ++i) {
      REQUIRE(std::abs(ramp.piece(i).jerk) <= J);
      t += ramp.piece(i).duration;
      const vpAxisState before = ramp.at(0., t - 1e-9 * T), after = ramp.at(0., t + 1e-9 * T);
      REQUIRE(std::abs(before[1] - after[1]) < 1e-7 * (1. + A * T));
      REQUIRE(std::abs(before[2] - after[2]) < 1e-7 * (A + J * T));
      if (i > 0 || std::abs(a) <= A) {
        REQUIRE(std::abs(after[2]) <= A * (1. + 1e-7));
      }
    }
    REQUIRE(ramp.at(0., T)[1] == Approx(target).margin(1e-12));
    REQUIRE(ramp.at(0., T + 1.)[1] == target);
    if (std::abs(a) <=
        A) { // no faster ramp: at full jerk and the shortest way it cannot be beaten by the sum of its parts
      REQUIRE(T >= std::abs(target - v - a * std::abs(a) / (2. * J)) / A - 1e-12);
    }
  }
}

TEST_CASE("shaped twists keep their limits for any input", "[shaper]")
{
  auto rng = vpTestSupport::generator(111);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 60; ++k) {
    vpTwistShaperLimits limits;
    limits.linearAcceleration = logUniform(rng, 0.2, 5.);
    limits.angularAcceleration = logUniform(rng, 0.2, 5.);
    limits.linearJerk = k % 3 == 0 ? none : logUniform(rng, 2., 200.);
    limits.angularJerk = k % 3 == 0 ? none : logUniform(rng, 2., 200.);
    limits.norm = k % 2 == 0;
    vpTwistShaper shaper(limits);
    vpTwist raw, before, rate;
    for (int i = 0; i < 1000; ++i) {
      const double dt = uniform(rng, 1e-3, 0.04);
      if (i % 17 == 0) {
        for (std::size_t c = 0; c < 6; ++c) {
          raw[c] = uniform(rng, -1., 1.);
        }
      }
      const vpTwist v = shaper.update(raw, dt);
      double worst[4] = {0., 0., 0., 0.}, sum[4] = {0., 0., 0., 0.};
      for (std::size_t c = 0; c < 6; ++c) {
        const double a = std::isfinite(limits.linearJerk) ? shaper.acceleration()[c] : (v[c] - before[c]) / dt;
        const double j = (shaper.acceleration()[c] - rate[c]) / dt;
        const int part = c < 3 ? 0 : 1;
        worst[part] = std::max(worst[part], std::abs(a));
        worst[2 + part] = std::max(worst[2 + part], std::abs(j));
        sum[part] += a * a;
        sum[2 + part] += j * j;
        if (std::isfinite(limits.linearJerk)) { // the twist is the integral of its rate
          const double jerk = c < 3 ? limits.linearJerk : limits.angularJerk;
          REQUIRE(std::abs(v[c] - before[c] - 0.5 * dt * (rate[c] + shaper.acceleration()[c])) <=
                  0.25 * jerk * dt * dt + 1e-12);
        }
      }
      const double bound[4] = {limits.linearAcceleration, limits.angularAcceleration, limits.linearJerk,
                               limits.angularJerk};
      for (int b = 0; b < 4; ++b) {
        CAPTURE(k, i, b);
        REQUIRE((limits.norm ? std::sqrt(sum[b]) : worst[b]) <= bound[b] * (1. + 1e-9));
      }
      before = v;
      rate = shaper.acceleration();
    }
    for (int i = 0; i < 3000; ++i) { // constant input: arrives exactly, and stays
      before = shaper.update(raw, 0.01);
    }
    for (std::size_t c = 0; c < 6; ++c) {
      CAPTURE(k, c);
      REQUIRE(before[c] == raw[c]);
      REQUIRE(shaper.acceleration()[c] == 0.);
    }
  }
}

TEST_CASE("the step of exponential visual servoing at t = 0 is gone, and the goal is still reached", "[shaper]")
{
  // v = -lambda e of figure 6.1, in closed loop with the shaped velocity.
  const double lambda = 1., dt = 1e-3;
  double e = 0.5, previous = 0., jump = 0., rawJump = lambda * 0.5;
  vpTwistShaper shaper;
  for (int i = 0; i < 15000; ++i) {
    const vpTwist v = shaper.update(vpTwist(-lambda * e, 0., 0., 0., 0., 0.), dt);
    jump = std::max(jump, std::abs(v[0] - previous));
    if (i == 0) {
      CHECK(std::abs(v[0]) <= 0.5 * 10. * dt * dt * (1. + 1e-9)); // jerk dt^2/2
    }
    previous = v[0];
    e += dt * v[0];
  }
  CHECK(jump <= 1. * dt * (1. + 1e-9)); // acceleration limit x dt, against a raw step of 0.5 m/s
  CHECK(rawJump > 400. * jump);
  CHECK(std::abs(e) < 1e-5);
}

TEST_CASE("from rest a change keeps its direction under norm limits", "[shaper]")
{
  vpTwistShaper shaper;
  const vpTwist raw(0.3, -0.6, 0.2, 0.1, 0.2, -0.4);
  for (int i = 0; i < 2000; ++i) {
    const vpTwist v = shaper.update(raw, 1e-3);
    REQUIRE(std::abs(v[0] * raw[1] - v[1] * raw[0]) < 1e-12);
    REQUIRE(std::abs(v[3] * raw[5] - v[5] * raw[3]) < 1e-12);
  }
}

TEST_CASE("the shaper starts from the present twist, brakes on bad input and checks its limits", "[shaper]")
{
  vpTwistShaper shaper;
  shaper.reset(vpTwist(0.2, 0., 0., 0., 0., 0.), vpTwist(0.5, 0., 0., 0., 0., 0.));
  CHECK(shaper.update(vpTwist(), 1e-3)[0] == Approx(0.2005).margin(1e-5));
  CHECK(shaper.update(vpTwist(1., 0., 0., 0., 0., 0.), -1.)[0] == shaper.twist()[0]);
  for (int i = 0; i < 2000; ++i) {
    static_cast<void>(shaper.update(vpTwist(NAN, 0., 0., 0., 0., 0.), 1e-3));
  }
  CHECK(shaper.twist()[0] == 0.);
  vpTwistShaperLimits limits;
  limits.angularJerk = 0.;
  CHECK_THROWS_WITH(vpTwistShaper(limits),
                    Catch::Contains("angular jerk limit of the twist shaper is 0 rad/s^3, must be > 0"));
}
