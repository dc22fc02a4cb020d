/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Polynomials and the closed forms based on them.
#include "vpTrajectoryTestKit.h"

#include <Eigen/LU>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

// Rounding of a coefficient in the product of n factors (s - r): 2 u for each factor, of the product of (1 + |r|); as
// much for its value by Horner's rule, and the root finder takes values below 2 epsilon of that for zero. A root moves
// by the sum over the slope there; to first order, so only where that is small against the distance to the next root.
TEST_CASE("roots of products of known factors are found, each once", "[polynomial]")
{
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  auto rng = vpTestSupport::generator(50);
  CAPTURE(vpTestSupport::seed());
  int sharp = 0;
  for (int k = 0; k < 20000; ++k) {
    const int degree = 1 + k % 8;
    const double lead = uniform(rng, 0.5, 2.);
    vpPolynomial p{lead};
    std::vector<double> all(static_cast<std::size_t>(degree)), known, errors;
    double size = lead;
    for (double &root : all) {
      root = uniform(rng, -0.5, 1.5);
      p = p.times({-root, 1.});
      size *= 1. + std::abs(root);
    }
    const double noise = (2. * degree + 2.) * epsilon * size;
    std::sort(all.begin(), all.end());
    bool separate = true;
    for (std::size_t i = 0; i < all.size(); ++i) {
      double slope = lead, gap = std::min(std::abs(all[i]), std::abs(1. - all[i]));
      for (std::size_t j = 0; j < all.size(); ++j) {
        slope *= j == i ? 1. : all[i] - all[j];
        gap = j == i ? gap : std::min(gap, std::abs(all[i] - all[j]));
      }
      const double error = noise / std::abs(slope);
      separate = separate && error < 0.01 * gap / degree;
      if (all[i] >= 0. && all[i] <= 1.) {
        known.push_back(all[i]);
        errors.push_back(1.1 * error + 4. * epsilon); // remainder of the higher orders; the step that ends Newton
      }
    }
    if (!separate) {
      continue; // clusters are ill-conditioned whatever the method
    }
    ++sharp;
    const auto roots = p.roots();
    CAPTURE(k, degree, noise);
    REQUIRE(roots.count == static_cast<int>(known.size()));
    for (std::size_t i = 0; i < known.size(); ++i) {
      REQUIRE(std::abs(roots.s[i] - known[i]) < errors[i]);
      REQUIRE(std::abs(p.value(roots.s[i])) < 3. * noise);
    }
  }
  CHECK(sharp > 19000);
}

TEST_CASE("special roots: double, at the ends, degenerate degrees", "[polynomial]")
{
  CHECK(vpPolynomial{0.25, -1., 1.}.roots().count == 1); // (s - 1/2)^2
  const auto touching = vpPolynomial{-0.5, 1.}.times({-0.5, 1.}).times({2., 1.}).roots();
  REQUIRE(touching.count == 1);
  CHECK(touching.s[0] == Approx(0.5));
  CHECK(vpPolynomial{0., 1., -1.}.roots().count == 2);    // 0 and 1
  CHECK(vpPolynomial{0., 0., 1.}.roots().count == 1);     // s^2
  CHECK(vpPolynomial{1., 0., 0., 0.}.roots().count == 0); // a constant stored with degree 3
  CHECK(vpPolynomial{}.roots().count == 0);
  CHECK(vpPolynomial{-0.3, 1., 0., 0., 0., 0.}.roots().count == 1); // a line stored with degree 5
  CHECK(vpPolynomial{1., 0., 1.}.roots().count == 0);
  // Small roots beside large coefficients: values near zero are small there without being roots.
  const auto small = vpPolynomial{-1e-9, 1.}.times({-3e-9, 1.}).times({2., -1.}).times({3., 1.}).roots();
  REQUIRE(small.count == 2);
  CHECK(small.s[0] == Approx(1e-9).epsilon(1e-9));
  CHECK(small.s[1] == Approx(3e-9).epsilon(1e-9));
}

TEST_CASE("range is the range of a dense sampling, and composition a change of clock", "[polynomial]")
{
  auto rng = vpTestSupport::generator(51);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 2000; ++k) {
    vpPolynomial p;
    p.setDegree(k % 9);
    for (int i = 0; i <= p.degree(); ++i) {
      p[i] = uniform(rng, -1., 1.);
    }
    const double a = uniform(rng, 0., 0.5), b = uniform(rng, 0.5, 1.);
    const auto range = p.range(a, b);
    const vpPolynomial q = p.composed(a, b - a);
    double low = 1e9, high = -1e9;
    for (int i = 0; i <= 400; ++i) {
      const double s = a + (b - a) * i / 400.;
      low = std::min(low, p.value(s));
      high = std::max(high, p.value(s));
      REQUIRE(std::abs(q.value(i / 400.) - p.value(s)) < 1e-13);
    }
    REQUIRE(range.min <= low + 1e-14);
    REQUIRE(range.min > low - 1e-3);
    REQUIRE(range.max >= high - 1e-14);
    REQUIRE(range.max < high + 1e-3);
    REQUIRE(p.value(range.atMax) == range.max);
    REQUIRE(p.value(range.atMin) == range.min);
    const auto jet = p.jet(a);
    REQUIRE(std::abs(jet[2] - p.derivative().derivative().value(a)) < 1e-11);
    REQUIRE(std::abs(jet[3] - p.derivative().derivative().derivative().value(a)) < 1e-10);
  }
}

namespace
{
// Sum of the magnitudes of all terms of the derivative d on [0, 1], each power of T of each coefficient separately: the
// coefficients may be small differences of these.
double termsOf(const vpMotionFamily &motion, int d, double T)
{
  double sum = 0.;
  for (int k = d; k <= motion.degree(); ++k) {
    double factor = 1., factorial = 1.;
    for (int i = 0; i < k; ++i) {
      factor *= i < d ? k - i : 1;
      factorial *= i + 1;
    }
    const auto row = motion.inDuration(0., k); // k! times the coefficient
    for (std::size_t m = 0; m < row.size(); ++m) {
      sum += factor / factorial * std::abs(row[m]) * std::pow(T, static_cast<double>(m));
    }
  }
  return sum;
}
} // namespace

// A coefficient takes about ten roundings of its terms, at most nine coefficients a Horner scheme of as many.
TEST_CASE("families meet their boundary values at every duration", "[family]")
{
  constexpr double rounded = 64. * std::numeric_limits<double>::epsilon();
  auto rng = vpTestSupport::generator(52);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 5000; ++k) {
    vpAxisState x{}, y{};
    for (std::size_t i = 0; i < 4; ++i) {
      x[i] = uniform(rng, -2., 2.);
      y[i] = uniform(rng, -2., 2.);
    }
    const double T = logUniform(rng, 0.05, 20.);
    const auto check = [&](const vpMotionFamily &motion, int first, int order) {
      const vpPolynomial p = motion.at(T);
      const auto begin = p.jet(0.), end = p.jet(1.);
      for (int d = 0; d < first + order; ++d) {
        const auto i = static_cast<std::size_t>(d);
        const double place = d == 0 ? x[0] : 0., unit = std::pow(T, d);
        const double error = rounded * (termsOf(motion, d, T) + 4. * unit);
        CAPTURE(T, d, first, order);
        REQUIRE(std::abs(begin[i] + place - x[i] * unit) < error);
        if (d >= first) {
          REQUIRE(std::abs(end[i] + place - y[i] * unit) < error);
        }
      }
      const double s = uniform(rng, 0., 1.);
      for (int d = 0; d < 4; ++d) {
        const auto c = motion.inDuration(s, d);
        REQUIRE(std::abs(c[0] + T * (c[1] + T * (c[2] + T * c[3])) - p.jet(s)[static_cast<std::size_t>(d)]) <
                rounded * termsOf(motion, d, T) + std::numeric_limits<double>::min());
      }
    };
    for (int order = 2; order <= 4; ++order) {
      check(vpMotionFamily::pointToPoint(x, y, order), 0, order);
      check(vpMotionFamily::velocityStep(x, y, order - 1), 1, order - 1);
    }
    check(vpMotionFamily::accelerationStep(x, y, 1), 2, 1);
    check(vpMotionFamily::accelerationStep(x, y, 2), 2, 2);
    const double tau = uniform(rng, 0.1, 0.9);
    const vpAxisState via{uniform(rng, -2., 2.), uniform(rng, -2., 2.), uniform(rng, -2., 2.), 0.};
    const vpMotionFamily six = vpMotionFamily::throughPosition(x, y, via[0], tau),
                         eight = vpMotionFamily::throughState(x, y, via, tau);
    check(six, 0, 3);
    check(eight, 0, 3);
    CHECK(six.degree() == 6);
    CHECK(eight.degree() == 8);
    REQUIRE(std::abs(six.at(T).value(tau) + x[0] - via[0]) < rounded * (termsOf(six, 0, T) + 4.));
    // Each order of the bump corrects the rounded remainder of the previous one at the via: w'/w is
    // 3 (1 - 2 tau)/(tau (1 - tau)).
    const double lever = 3. / (tau * (1. - tau));
    const auto through = eight.at(T).jet(tau);
    double inherited = 0.;
    for (int d = 0; d < 3; ++d) {
      const double unit = std::pow(T, d);
      inherited = lever * inherited + rounded * (termsOf(eight, d, T) + 4. * unit);
      CAPTURE(T, tau, d);
      REQUIRE(std::abs(through[static_cast<std::size_t>(d)] + (d == 0 ? x[0] : 0.) -
                       via[static_cast<std::size_t>(d)] * unit) < inherited);
    }
  }
}

TEST_CASE("the quintic is the solution of the Vandermonde system (3.61)", "[family]")
{
  auto rng = vpTestSupport::generator(53);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 1000; ++k) {
    const double T = uniform(rng, 0.5, 3.);
    Eigen::Matrix<double, 6, 6> V = Eigen::Matrix<double, 6, 6>::Zero();
    for (int i = 0; i < 6; ++i) {
      V(0, i) = i == 0;
      V(1, i) = i == 1;
      V(2, i) = i == 2 ? 2. : 0.;
      V(3, i) = std::pow(T, i);
      V(4, i) = i < 1 ? 0. : i * std::pow(T, i - 1);
      V(5, i) = i < 2 ? 0. : i * (i - 1) * std::pow(T, i - 2);
    }
    const Eigen::Matrix<double, 6, 1> b =
        Eigen::Matrix<double, 6, 1>::NullaryExpr([&](Eigen::Index) { return uniform(rng, -1., 1.); });
    const Eigen::Matrix<double, 6, 1> a = V.fullPivLu().solve(b);
    const vpPolynomial p = vpMotionFamily::pointToPoint({b[0], b[1], b[2], 0.}, {b[3], b[4], b[5], 0.}, 3).at(T);
    for (int i = 1; i < 6; ++i) {
      REQUIRE(std::abs(p[i] - a[i] * std::pow(T, i)) < 1e-10);
    }
  }
}
