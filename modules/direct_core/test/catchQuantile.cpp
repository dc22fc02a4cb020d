/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Medians and percentiles against a sort; unknown pose covariance.
#include <visp3/direct_core/vpPoseCovariance.h>
#include <visp3/direct_core/vpQuantile.h>

#include "vpCatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

VISP_DIRECT_USING_NAMESPACE

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
