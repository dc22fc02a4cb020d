/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Adversarial tests of the guarantee of vpViewConstraintFilter, and invalid numbers.
#include "vpCatch.h"
#include "vpServoScene.h"
#include "vpWildNumbers.h"

#include <visp3/feedforward/vpViewConstraintFilter.h>

#include <array>

namespace
{
using namespace vpServoScene;

double logUniform(std::mt19937_64 &rng, double low, double high)
{
  return std::exp(uniform(rng, std::log(low), std::log(high)));
}

// A view and the parameters of a request.
vpViewConstraintSpec randomConfig(std::mt19937_64 &rng)
{
  vpViewConstraintSpec spec;
  spec.left = -uniform(rng, 0.1, 1.2);
  spec.right = uniform(rng, 0.1, 1.2);
  spec.top = -uniform(rng, 0.1, 0.9);
  spec.bottom = uniform(rng, 0.1, 0.9);
  spec.period = logUniform(rng, 1e-3, 0.1);
  spec.gamma = uniform(rng, 0.05, 1.) * 0.5 / spec.period;
  spec.maxLinear = logUniform(rng, 0.05, 20.);
  spec.maxAngular = logUniform(rng, 0.05, 20.);
  spec.imageUncertainty = rng() % 3 == 0 ? uniform(rng, 0., 0.01) : 0.;
  spec.depthUncertainty = rng() % 3 == 0 ? uniform(rng, 0., 0.9) : 0.;
  return spec;
}

// A coordinate inside the view; on its border in a third of the cases.
double inside(std::mt19937_64 &rng, double low, double high)
{
  switch (rng() % 6) {
  case 0:
    return low;
  case 1:
    return high;
  default:
    return uniform(rng, low, high);
  }
}

// Maximum distance of a point outside the view under a constant twist, at 16 times up to T: P' = -v - w x P, by
// Runge-Kutta.
double farthest(const vpServoPoint &start, const vpTwist &twist, double T, const vpViewConstraintSpec &spec)
{
  const Eigen::Vector3d v(twist[0], twist[1], twist[2]), w(twist[3], twist[4], twist[5]);
  const auto rate = [&](const Eigen::Vector3d &P) { return Eigen::Vector3d(-v - w.cross(P)); };
  Eigen::Vector3d P = start.Z * Eigen::Vector3d(start.x, start.y, 1.);
  double worst = -1.;
  const double h = T / 16.;
  for (int i = 0; i < 16; ++i) {
    const Eigen::Vector3d a = rate(P), b = rate(P + 0.5 * h * a), c = rate(P + 0.5 * h * b), d = rate(P + h * c);
    P += h / 6. * (a + 2. * b + 2. * c + d);
    if (!(P.z() > 0.)) {
      return 1e9; // behind the camera
    }
    const double x = P.x() / P.z(), y = P.y() / P.z();
    worst = std::max({worst, spec.left - x, x - spec.right, spec.top - y, y - spec.bottom});
  }
  return worst;
}
} // namespace

TEST_CASE("10^6 random cases: no point in the view leaves it while the answer is executed", "[filter][brute]")
{
  auto rng = vpTestSupport::generator(91);
  CAPTURE(vpTestSupport::seed());
  std::vector<vpServoPoint> outline, truth;
  int moving = 0, long_ = 0, borders = 0;
  const int cases = vpTestSupport::longer(100000);
  for (int k = 0; k < cases; ++k) {
    const vpViewConstraintSpec spec = randomConfig(rng);
    vpViewConstraintFilter filter(spec);
    const double u = spec.imageUncertainty, d = spec.depthUncertainty;
    const int count = 1 + static_cast<int>(rng() % 4);
    outline.clear();
    truth.clear();
    for (int i = 0; i < count; ++i) {
      const vpServoPoint told{inside(rng, spec.left + u, spec.right - u), inside(rng, spec.top + u, spec.bottom - u),
                              logUniform(rng, 0.02, 20.), true};
      outline.push_back(told);
      truth.push_back(
          {told.x + uniform(rng, -u, u), told.y + uniform(rng, -u, u), told.Z * (1. + uniform(rng, -d, d)), true});
    }
    // Fast and slow; every fourth one slides along a border and rolls or pans, so that the path curves outwards.
    vpTwist v =
        randomTwist(rng, logUniform(rng, 0.01, 3.) * spec.maxLinear, logUniform(rng, 0.01, 3.) * spec.maxAngular);
    if (k % 4 == 0) {
      v = vpTwist(rng() % 2 ? v[0] : 0., rng() % 2 ? v[1] : 0., rng() % 2 ? v[2] : 0., rng() % 2 ? v[3] : 0.,
                  rng() % 2 ? v[4] : 0., v[5]);
    }
    const double dt = k % 3 == 0 ? logUniform(rng, 1e-3, 10.) : uniform(rng, 0.1, 1.) * spec.period;
    const double T = std::max(dt, spec.period);
    const vpServoCommand command = filter.filter({v, vpServoStatus::Servoing}, outline, dt);
    if (!(command.v.linearNorm() <= spec.maxLinear * (1. + 1e-12)) ||
        !(command.v.angularNorm() <= spec.maxAngular * (1. + 1e-12)) || command.status == vpServoStatus::InvalidInput) {
      FAIL("the speed limit is broken, or good input refused");
    }
    for (int i = 0; i < count; ++i) {
      const double out = farthest(truth[static_cast<std::size_t>(i)], command.v, T, spec);
      if (!(out <= 1e-9)) {
        CAPTURE(k, i, count, out, dt, spec.period, u, d);
        FAIL("a point left the view");
      }
      borders += out > -1e-3 ? 1 : 0;
    }
    moving += command.v.linearNorm() + command.v.angularNorm() > 1e-3 ? 1 : 0;
    long_ += dt > spec.period && command.v.linearNorm() > 0. ? 1 : 0;
  }
  CAPTURE(moving, long_, borders);
  CHECK(moving > cases / 3);   // it does not just stand still,
  CHECK(long_ > cases / 20);   // not for a long time step either,
  CHECK(borders > cases / 20); // and goes near the border
}

TEST_CASE("wild numbers do not get through the view filter", "[filter][wild]")
{
  auto rng = vpTestSupport::generator(92);
  CAPTURE(vpTestSupport::seed());
  const auto run = [](const std::array<double, 13> &x) {
    const vpViewConstraintSpec spec;
    vpViewConstraintFilter filter(spec);
    const std::vector<vpServoPoint> outline{{x[0], x[1], x[2], true}, {x[3], x[4], x[5], true}};
    const vpServoCommand command =
        filter.filter({{x[6], x[7], x[8], x[9], x[10], x[11]}, vpServoStatus::Servoing}, outline, x[12]);
    REQUIRE(command.v.isFinite());
    REQUIRE(vpWildNumbers::atMost(command.v.linearNorm(), spec.maxLinear));
    REQUIRE(vpWildNumbers::atMost(command.v.angularNorm(), spec.maxAngular));
    if (!vpWildNumbers::allFinite(x) || !(x[2] > 0.) || !(x[5] > 0.) || !(x[12] > 0.)) {
      REQUIRE(command.status == vpServoStatus::InvalidInput);
      REQUIRE(command.v.linearNorm() + command.v.angularNorm() == 0.);
    }
  };
  const std::array<double, 13> ordinary{0.1, -0.1, 0.5, -0.2, 0.05, 0.8, 0.1, 0.2, -0.1, 0.1, 0.3, -0.2, 0.01};
  vpWildNumbers::everyPlace(ordinary, [&](const auto &x, std::size_t place, std::size_t value) {
    CAPTURE(place, value);
    run(x);
  });
  for (int k = 0; k < 20000; ++k) {
    std::array<double, 13> x = ordinary;
    vpWildNumbers::mix(rng, x, 0.25);
    CAPTURE(k);
    run(x);
  }
}
