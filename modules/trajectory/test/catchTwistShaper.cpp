/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The shaper keeps its limits for any input, arrives exactly, and removes the step at t = 0.
#include "vpTrajectoryTestKit.h"
#include "vpWildNumbers.h"

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
      const vpTwist v = shaper.step(raw, dt);
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
      before = shaper.step(raw, 0.01);
    }
    for (std::size_t c = 0; c < 6; ++c) {
      CAPTURE(k, c);
      REQUIRE(before[c] == raw[c]);
      REQUIRE(shaper.acceleration()[c] == 0.);
    }
  }
}

namespace
{
// Recomputed from the output twists by differences: the shaper's own state is not used.
class Recheck
{
public:
  explicit Recheck(const vpTwistShaperLimits &limits) : m_limits(limits) {}

  void wish(const vpTwist &raw)
  {
    m_fastest[0] = std::max(m_fastest[0], raw.linearNorm());
    m_fastest[1] = std::max(m_fastest[1], raw.angularNorm());
  }

  // The largest of speed, acceleration and jerk, each over its bound.
  double step(const vpTwist &v, double dt)
  {
    double worst = std::max(ratio(v.linearNorm(), m_fastest[0]), ratio(v.angularNorm(), m_fastest[1]));
    for (std::size_t part = 0; part < 6; part += 3) {
      const double maxA = part == 0 ? m_limits.linearAcceleration : m_limits.angularAcceleration;
      const double maxJ = part == 0 ? m_limits.linearJerk : m_limits.angularJerk;
      double a[3], j[3];
      for (std::size_t i = 0; i < 3; ++i) {
        a[i] = (v[part + i] - m_twist[part + i]) / dt;
        j[i] = 2. * (a[i] - m_rate[part + i]) / (dt + m_dt); // mean rates belong to the middle of the steps
        m_rate[part + i] = a[i];
      }
      // Differences of speeds lose digits in short steps.
      const double loss = 1e-15 * m_fastest[part / 3] / dt;
      worst = std::max(worst, ratio(size(a) - loss, maxA));
      worst = std::max(worst, ratio(size(j) - 4. * loss / (dt + m_dt), maxJ));
    }
    m_twist = v;
    m_dt = dt;
    return worst;
  }

private:
  static double ratio(double value, double bound) { return value <= 0. ? 0. : value / bound; }
  double size(const double (&x)[3]) const
  {
    return m_limits.norm ? std::hypot(std::hypot(x[0], x[1]), x[2])
                         : std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
  }

  vpTwistShaperLimits m_limits;
  vpTwist m_twist, m_rate;
  double m_fastest[2] = {0., 0.}, m_dt = 0.;
};

vpTwist randomWish(std::mt19937_64 &rng, int kind, int step, const vpTwist &before)
{
  vpTwist raw = before;
  for (std::size_t c = 0; c < 6; ++c) {
    switch (kind) {
    case 0: // turns on the limit, in any plane, and back
      raw[c] = std::cos(0.02 * step * (1. + 0.3 * static_cast<double>(c)) + static_cast<double>(c));
      break;
    case 1: // another one every cycle
      raw[c] = uniform(rng, -1., 1.);
      break;
    case 2: // jumps now and then
      raw[c] = step % 23 == 0 ? uniform(rng, -1., 1.) * (step % 2 == 0 ? 1. : 0.1) : before[c];
      break;
    default: // noise on a motion, opposite corners
      raw[c] = (step / 40 % 2 == 0 ? 1. : -1.) * (c % 3 == 0 ? 1. : 0.2) + uniform(rng, -0.1, 0.1);
    }
  }
  return vpLimitTwist(raw, 0.25, 0.9);
}
} // namespace

TEST_CASE("10^6 random steps: speed, acceleration and jerk, rechecked by differences", "[shaper][brute]")
{
  auto rng = vpTestSupport::generator(112);
  CAPTURE(vpTestSupport::seed());
  const int runs = vpTestSupport::longer(100), steps = 1000;
  double atLimit = 0.;
  for (int k = 0; k < runs; ++k) {
    vpTwistShaperLimits limits;
    limits.linearAcceleration = logUniform(rng, 0.1, 10.);
    limits.angularAcceleration = logUniform(rng, 0.1, 10.);
    limits.linearJerk = k % 5 == 0 ? none : logUniform(rng, 1., 300.);
    limits.angularJerk = k % 5 == 0 ? none : logUniform(rng, 1., 300.);
    limits.norm = k % 3 != 0;
    vpTwistShaper shaper(limits);
    Recheck recheck(limits);
    vpTwist raw;
    for (int i = 0; i < steps; ++i) {
      const double dt = k % 2 == 0 ? 0.01 : uniform(rng, 1e-3, 0.04);
      raw = randomWish(rng, k / 2 % 4, i, raw);
      recheck.wish(raw);
      const vpTwist v = shaper.step(raw, dt);
      const double worst = recheck.step(v, dt);
      CAPTURE(k, i, worst);
      if (!vpWildNumbers::atMost(worst, 1.)) {
        FAIL("a limit is broken");
      }
      atLimit = std::max(atLimit, v.linearNorm());
    }
  }
  CHECK(atLimit > 0.249); // the limit was approached
}

TEST_CASE("a wish that turns on the speed limit is followed on it, not beyond", "[shaper]")
{
  // Without the check against the ball the largest speed was 1.07 of the limit at 0.5 rad/s and 1.29 at 2 rad/s.
  for (const bool norm : {true, false}) {
    for (const double rate : {0.2, 0.5, 1., 2.}) {
      vpTwistShaperLimits limits{0.5, 5., 2., 20., norm};
      vpTwistShaper shaper(limits);
      double fastest = 0., error = 0.;
      for (int k = 0; k < 3000; ++k) {
        const double angle = 0.01 * k * rate;
        const vpTwist raw =
            vpLimitTwist(vpTwist(0.25 * std::cos(angle), 0.25 * std::sin(angle), 0., 0., 0., 0.), 0.25, 1.);
        const vpTwist v = shaper.step(raw, 0.01);
        fastest = std::max(fastest, v.linearNorm() / 0.25);
        error = k > 1000 ? std::max(error, std::hypot(v[0] - raw[0], v[1] - raw[1])) : 0.;
      }
      CAPTURE(norm, rate, error);
      CHECK(fastest <= 1. + 1e-9);
      CHECK(fastest > 0.9);
      CHECK((rate > 1.5 || error < 0.05)); // 2 rad/s needs 0.5 m/s^2: the whole limit
    }
  }
}

TEST_CASE("wild numbers do not get through the shaper", "[shaper][wild]")
{
  auto rng = vpTestSupport::generator(113);
  CAPTURE(vpTestSupport::seed());
  const auto twistOf = [](const std::array<double, 6> &x) { return vpTwist(x[0], x[1], x[2], x[3], x[4], x[5]); };
  for (int k = 0; k < 300; ++k) {
    vpTwistShaperLimits limits;
    limits.norm = k % 2 == 0;
    limits.linearJerk = limits.angularJerk = k % 3 == 0 ? none : 10.;
    vpTwistShaper shaper(limits);
    if (k % 5 == 0) {
      std::array<double, 6> v{}, a{};
      vpWildNumbers::mix(rng, v, 0.5);
      vpWildNumbers::mix(rng, a, 0.5);
      shaper.reset(twistOf(v), twistOf(a));
      REQUIRE(shaper.twist().isFinite());
      shaper.reset();
    }
    for (int i = 0; i < 100; ++i) {
      std::array<double, 6> raw;
      for (double &x : raw) {
        x = vpWildNumbers::mixed(rng, uniform(rng, -1., 1.), 0.1);
      }
      const double dt = vpWildNumbers::mixed(rng, 0.01, 0.3);
      const vpTwist before = shaper.twist(), v = shaper.step(twistOf(raw), dt);
      CAPTURE(k, i, dt);
      REQUIRE(v.isFinite());
      REQUIRE(shaper.acceleration().isFinite());
      const double step = std::isfinite(dt) && dt > 0. ? std::min(dt, vpTwistShaper::longestStep) : 0.;
      for (std::size_t c = 0; c < 6; ++c) {
        REQUIRE(vpWildNumbers::atMost(v[c] - before[c], step + 1e-12)); // limits of 1 m/s^2 and 1 rad/s^2
      }
    }
  }
  vpWildNumbers::everyPlace(std::array<double, 4>{1., 10., 1., 10.}, [&](const auto &x, std::size_t, std::size_t) {
    vpTwistShaperLimits wild{x[0], x[1], x[2], x[3], true};
    try {
      vpTwistShaper shaper(wild);
      for (int i = 0; i < 100; ++i) {
        REQUIRE(shaper.step(vpTwist(1., -1., 0.5, 1., 0., 0.), 0.01).isFinite());
      }
    }
    catch (const vpException &) { // a limit out of its range
    }
  });
}

TEST_CASE("the step of exponential visual servoing at t = 0 is gone, and the goal is still reached", "[shaper]")
{
  // v = -lambda e of figure 6.1, in closed loop with the shaped velocity.
  const double lambda = 1., dt = 1e-3;
  double e = 0.5, previous = 0., jump = 0., rawJump = lambda * 0.5;
  vpTwistShaper shaper;
  for (int i = 0; i < 15000; ++i) {
    const vpTwist v = shaper.step(vpTwist(-lambda * e, 0., 0., 0., 0., 0.), dt);
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
    const vpTwist v = shaper.step(raw, 1e-3);
    REQUIRE(std::abs(v[0] * raw[1] - v[1] * raw[0]) < 1e-12);
    REQUIRE(std::abs(v[3] * raw[5] - v[5] * raw[3]) < 1e-12);
  }
}

TEST_CASE("the shaper starts from the present twist, brakes on bad input and checks its limits", "[shaper]")
{
  vpTwistShaper shaper;
  shaper.reset(vpTwist(0.2, 0., 0., 0., 0., 0.), vpTwist(0.5, 0., 0., 0., 0., 0.));
  CHECK(shaper.step(vpTwist(), 1e-3)[0] == Approx(0.2005).margin(1e-5));
  CHECK(shaper.step(vpTwist(1., 0., 0., 0., 0., 0.), -1.)[0] == shaper.twist()[0]);
  for (int i = 0; i < 2000; ++i) {
    static_cast<void>(shaper.step(vpTwist(NAN, 0., 0., 0., 0., 0.), 1e-3));
  }
  CHECK(shaper.twist()[0] == 0.);
  vpTwistShaperLimits limits;
  limits.angularJerk = 0.;
  CHECK_THROWS_WITH(vpTwistShaper(limits),
                    Catch::Contains("angularJerk of the twist shaper is 0 rad/s^3, must be 1e-06..1e+12 or infinite"));
}
