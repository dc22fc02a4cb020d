/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include <visp3/direct_core/vpPoseCovariance.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpTailProbability.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

VISP_DIRECT_USING_NAMESPACE

// Medians and percentiles against a sort; unknown pose covariance.
TEST_CASE("the median of 1..10 is 5.5, and an empty sample has none")
{
  std::vector<double> values(10);
  std::iota(values.rbegin(), values.rend(), 1.);
  CHECK(vpMedian(values) == 5.5);
  CHECK(vpQuantile(values, 0.) == 1.);
  CHECK(vpQuantile(values, 1.) == 10.);
  CHECK(vpQuantile(values, 7.) == 10.);
  CHECK(vpQuantile(values, 0.99) == Approx(9.91).epsilon(1e-14));
  CHECK(vpMedian({3.}) == 3.);
  CHECK(std::isnan(vpMedian({})));
  CHECK(std::isnan(vpQuantile(values, std::nan(""))));
  const double far = std::numeric_limits<double>::infinity();
  CHECK(vpMedian({1., far, far, 2.}) == far);
  CHECK(vpMedian({far, far}) == far);
}

TEST_CASE("quantiles lie between the neighbours of a sorted sample")
{
  const unsigned int seed = vpTestSupport::seed();
  CAPTURE(seed);
  std::mt19937_64 random = vpTestSupport::generator();
  std::uniform_real_distribution<double> number(-1., 1.);
  for (int problem = 0; problem < 2000; ++problem) {
    std::vector<double> values(1 + random() % 30);
    std::generate(values.begin(), values.end(), [&] { return std::round(20. * number(random)) / 20.; });
    const double share = 0.5 + 0.5 * number(random);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(place);
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    const double expected = sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
    CHECK(vpQuantile(values, share) == Approx(expected).margin(1e-15));
  }
}

TEST_CASE("a pose of which nothing is known is not known exactly")
{
  vpPoseCovariance covariance;
  CHECK(std::isinf(covariance.rotationDeviation()));
  covariance.known = true;
  covariance(0, 0) = covariance(1, 1) = covariance(2, 2) = 4e-6 / 3.;
  covariance(5, 5) = 9e-4;
  CHECK(covariance.positionDeviation() == Approx(2e-3));
  CHECK(covariance.rotationDeviation() == Approx(3e-2));
  covariance(3, 3) = std::nan("");
  CHECK(std::isinf(covariance.rotationDeviation()));
}

// Tails of the chi-square and of Fisher's distribution against tables, and against drawn samples.
TEST_CASE("the tails are those of the tables")
{
  CHECK(vpChiSquareTail(3.841, 1.) == Approx(0.05).epsilon(1e-3));
  CHECK(vpChiSquareTail(18.307, 10.) == Approx(0.05).epsilon(1e-3));
  CHECK(vpChiSquareTail(135.807, 100.) == Approx(0.01).epsilon(1e-3));
  CHECK(vpFisherTail(4.965, 1., 10.) == Approx(0.05).epsilon(1e-3));
  CHECK(vpFisherTail(3.326, 5., 10.) == Approx(0.05).epsilon(1e-3));
  CHECK(vpFisherTail(1.598, 100., 100.) == Approx(0.01).epsilon(5e-3));
}

TEST_CASE("the ends of the tails")
{
  const double far = std::numeric_limits<double>::infinity(), no = std::nan("");
  for (const double degrees : {1., 2., 7., 120., 5000.}) {
    CAPTURE(degrees);
    CHECK(vpChiSquareTail(0., degrees) == 1.);
    CHECK(vpChiSquareTail(far, degrees) == 0.);
    CHECK(vpChiSquareTail(1e9, degrees) == 0.);
    CHECK(vpFisherTail(0., degrees, 3.) == 1.);
    CHECK(vpFisherTail(far, degrees, 3.) == 0.);
    CHECK(vpFisherTail(1e12, degrees, 500.) < 1e-100);
    // With a known deviation in the denominator, Fisher's is the chi-square.
    CHECK(vpFisherTail(1.3, degrees, 1e7) ==
          Approx(vpChiSquareTail(1.3 * degrees, degrees)).epsilon(1e-2).margin(1e-9));
  }
  CHECK(std::isnan(vpChiSquareTail(no, 3.)));
  CHECK(std::isnan(vpChiSquareTail(-1., 3.)));
  CHECK(std::isnan(vpChiSquareTail(1., 0.)));
  CHECK(std::isnan(vpChiSquareTail(1., far)));
  CHECK(std::isnan(vpFisherTail(no, 3., 3.)));
  CHECK(std::isnan(vpFisherTail(1., 0., 3.)));
  CHECK(std::isnan(vpFisherTail(1., 3., no)));
}

TEST_CASE("so many samples lie in the tail as it says")
{
  CAPTURE(vpTestSupport::seed());
  constexpr int samples = 20000;
  std::mt19937_64 random = vpTestSupport::generator(1);
  for (int trial = 0; trial < 10; ++trial) {
    const int above = std::uniform_int_distribution<int>(1, 30)(random);
    const int below = std::uniform_int_distribution<int>(1, 30)(random);
    std::chi_squared_distribution<double> a(above), b(below);
    double chi = 0., fisher = 0.; // samples whose tail is below a tenth
    for (int i = 0; i < samples; ++i) {
      const double x = a(random);
      chi += vpChiSquareTail(x, above) < 0.1 ? 1. : 0.;
      fisher += vpFisherTail(x / above / (b(random) / below), above, below) < 0.1 ? 1. : 0.;
    }
    CAPTURE(above, below);
    const double spread = 5. * std::sqrt(0.1 * 0.9 / samples); // five deviations of a count
    CHECK(chi / samples == Approx(0.1).margin(spread));
    CHECK(fisher / samples == Approx(0.1).margin(spread));
  }
}
