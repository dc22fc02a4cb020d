/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include <visp3/printing/vpAlphaBetaFilter.h>
#include <visp3/printing/vpCellVelocity.h>

#include <cmath>
#include <complex>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

// Against a direct simulation of the difference equations: stability, variances, damping, tracking.
namespace
{
using vpTestSupport::uniform;

//! Largest |eigenvalue| of the error's recursion [(1 - a), (1 - a) T; -b / T, 1 - b].
double spectralRadius(double alpha, double beta)
{
  const double trace = 2. - alpha - beta, determinant = 1. - alpha;
  const std::complex<double> root = std::sqrt(std::complex<double>(trace * trace - 4. * determinant, 0.));
  return std::max(std::abs(0.5 * (trace + root)), std::abs(0.5 * (trace - root)));
}
} // namespace

TEST_CASE("Gains are accepted exactly where the recursion is stable", "[alphabeta]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  int stable = 0;
  for (int k = 0; k < 20000; ++k) {
    vpAlphaBetaGains gains;
    gains.alpha = uniform(rng, -0.5, 2.5);
    gains.beta = uniform(rng, -0.5, 5.);
    const double radius = spectralRadius(gains.alpha, gains.beta);
    if (std::fabs(radius - 1.) < 1e-9) {
      continue;
    }
    CAPTURE(gains.alpha, gains.beta, radius);
    if (radius < 1.) {
      ++stable;
      REQUIRE_NOTHROW(vpAlphaBetaFilter(gains));
    }
    else {
      REQUIRE_THROWS(vpAlphaBetaFilter(gains));
    }
  }
  CHECK(stable > 3000);
}

TEST_CASE("Critical damping puts both poles in one place", "[alphabeta]")
{
  for (double alpha = 0.01; alpha < 1.; alpha += 0.01) {
    const vpAlphaBetaGains gains = vpAlphaBetaGains::criticallyDamped(alpha);
    const double trace = 2. - gains.alpha - gains.beta;
    CHECK(trace * trace - 4. * (1. - alpha) == Approx(0.).margin(1e-12));
    // No overshoot: the residual of a step in the rate never changes its sign.
    vpAlphaBetaFilter filter(gains);
    filter.reset(0., 0.);
    for (int k = 1; k < 100; ++k) {
      CHECK(filter.step(k).residual > -1e-12);
    }
  }
}

TEST_CASE("The Kalman gains are those of the Riccati equation", "[alphabeta]")
{
  for (double q = 1e-4; q < 10.; q *= 1.7) { // variance of the acceleration over T^4 / sigma^2
    double p = 10., c = 5., v = 10.;         // predicted covariance
    double alpha = 0., beta = 0.;
    for (int k = 0; k < 20000; ++k) {
      alpha = p / (p + 1.);
      beta = c / (p + 1.);
      const double P = (1. - alpha) * p, C = (1. - alpha) * c, V = v - beta * c;
      p = P + 2. * C + V + q / 4.;
      c = C + V + q / 2.;
      v = V + q;
    }
    CAPTURE(q, alpha);
    CHECK(vpAlphaBetaGains::steadyKalman(alpha).beta == Approx(beta).epsilon(1e-7));
  }
}

TEST_CASE("Variances of white noise are as documented", "[alphabeta]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal(0., 1.);
  for (int problem = 0; problem < 12; ++problem) {
    vpAlphaBetaGains gains;
    gains.alpha = uniform(rng, 0.1, 1.2);
    gains.beta = uniform(rng, 0.05, 0.7) * (4. - 2. * gains.alpha);
    const double T = uniform(rng, 0.2, 3.);
    vpAlphaBetaFilter filter(gains, T);
    filter.reset(0., 0.);
    double value = 0., rate = 0.;
    constexpr int n = 200000;
    for (int k = 0; k < n; ++k) {
      const auto &state = filter.step(normal(rng));
      value += state.value * state.value;
      rate += state.rate * state.rate;
    }
    CAPTURE(gains.alpha, gains.beta, T);
    CHECK(value / n == Approx(gains.valueVariance()).epsilon(0.05));
    CHECK(rate / n * T * T == Approx(gains.rateVariance()).epsilon(0.05));
  }
}

TEST_CASE("A known acceleration is followed without error, a missing measurement bridged", "[alphabeta]")
{
  auto rng = vpTestSupport::generator(3);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 500; ++problem) {
    const double T = uniform(rng, 0.1, 2.), a = uniform(rng, -1., 1.), v = uniform(rng, -5., 5.),
                 p = uniform(rng, -9., 9.);
    vpAlphaBetaFilter filter({uniform(rng, 0.1, 0.9), 0.1}, T);
    filter.reset(p, v);
    for (int k = 1; k < 60; ++k) {
      const double t = k * T, truth = p + v * t + 0.5 * a * t * t;
      const auto &state = k % 7 == 0 ? filter.step(NAN, a) : filter.step(truth, a);
      REQUIRE(state.value == Approx(truth).margin(1e-9 * (1. + std::fabs(truth))));
      REQUIRE(state.rate == Approx(v + a * t).margin(1e-9));
      REQUIRE(filter.predict(2. * T) == Approx(truth + 2. * T * (v + a * t)).margin(1e-8));
    }
  }
}

TEST_CASE("An alpha-beta filter says what is wrong and does not allocate", "[alphabeta]")
{
  CHECK_THROWS_WITH(vpAlphaBetaFilter({0., 0.1}),
                    Catch::Contains("alpha of the alpha-beta filter is 0, must be in (0, 2)"));
  CHECK_THROWS_WITH(vpAlphaBetaFilter({0.5, 3.}),
                    Catch::Contains("beta of the alpha-beta filter is 3, must be in (0, 4 - 2 alpha)"));
  CHECK_THROWS_WITH(vpAlphaBetaFilter({0.5, 0.1}, 0.), Catch::Contains("period of the alpha-beta filter is 0"));
  CHECK_THROWS_WITH(vpAlphaBetaGains::criticallyDamped(1.), Catch::Contains("alpha of the alpha-beta filter is 1"));
  vpAlphaBetaFilter filter;
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 1000; ++k) {
    filter.step(k);
  }
  CHECK(vpTestSupport::allocationCount() == before);
}

// Thesis (7.24) and (7.27) as printed on a passing product, compared with those used here. See doc/errata.md.
namespace
{
constexpr double pitch = 48.9, width = 160.;
constexpr int columns = 200; // to the left: 1000 frames at 8 px/frame at most pass 164

// One row of a product at \e x: the cells that lie in the image, from left to right.
std::vector<vpPatternCell> look(double x)
{
  std::vector<vpPatternCell> cells;
  for (int column = -columns; column <= 4; ++column) {
    vpPatternCell cell;
    cell.column = column;
    cell.x = x + column * pitch;
    cell.sigmaX = cell.sigmaY = 0.1;
    cell.valid = true;
    if (cell.x > 20. && cell.x < width - 20.) {
      cells.push_back(cell);
    }
  }
  return cells;
}
} // namespace

TEST_CASE("(7.27): counted from the left the velocity jumps when a cell enters, by identity it does not", "[errata]")
{
  auto rng = vpTestSupport::generator(31);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> velocity(2., 8.);
  int jumps = 0, changes = 0;
  double x = 0.;
  for (int k = 0; k < 1000; ++k) {
    const double v = velocity(rng);
    const std::vector<vpPatternCell> before = look(x), now = look(x + v);
    x += v;
    const std::size_t n = std::min(before.size(), now.size()); // n_d of the text
    double printed = 0.;
    for (std::size_t i = 0; i < n; ++i) {
      printed += (now[i].x - before[i].x) / static_cast<double>(n);
    }
    const bool entered = now.front().column != before.front().column;
    changes += entered;
    jumps += std::abs(printed - v) > 0.9 * pitch;
    const vpCellVelocity ours = vpFindCellVelocity(before.data(), before.size(), now.data(), now.size());
    REQUIRE(ours.cells >= 1);
    REQUIRE(ours.vx == Approx(v).margin(1e-9));
  }
  CHECK(changes > 50);
  CHECK(jumps == changes);
}

TEST_CASE("(7.24): with velocities per frame the period is a frame, not the loop time", "[errata]")
{
  const double v = 5., loop = 1. / 1600.; // px/frame, s
  vpAlphaBetaFilter filter(vpAlphaBetaGains::criticallyDamped(0.4), 1.);
  for (int k = 0; k < 200; ++k) {
    filter.step(v * k);
  }
  const double now = v * 199.;
  CHECK(filter.predict(1.) == Approx(now + v).margin(1e-6)); // position of the cell in the next two frames
  CHECK(filter.predict(2.) == Approx(now + 2. * v).margin(1e-6));
  const double printed = filter.state().value + 2. * loop * filter.state().rate;
  CHECK(now + 2. * v - printed > 9.9);
}
