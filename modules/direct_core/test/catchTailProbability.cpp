/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Tails of the chi-square and of Fisher's distribution against tables, and against drawn samples.
#include <visp3/direct_core/vpTailProbability.h>

#include "vpCatch.h"

#include <cmath>
#include <limits>

VISP_DIRECT_USING_NAMESPACE

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
