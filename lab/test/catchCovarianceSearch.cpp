/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The search finds least values that are known, inside the cube and on its border.
#include "vpCatch.h"

#include "lab/printing/vpCovarianceSearch.h"

#include <Eigen/QR>

#include <cmath>
#include <random>

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
VectorXd drawn(int n, std::mt19937_64 &random, double low, double high)
{
  std::uniform_real_distribution<double> between(low, high);
  return VectorXd::NullaryExpr(n, [&] { return between(random); });
}
} // namespace

TEST_CASE("Least values of turned ellipsoids are found, whatever their axes", "[search]")
{
  auto random = vpTestSupport::generator(731);
  CAPTURE(vpTestSupport::seed());
  for (const int n : {2, 8, 18}) {
    const VectorXd least = drawn(n, random, 0.2, 0.8);
    const MatrixXd axes = Eigen::HouseholderQR<MatrixXd>(MatrixXd::NullaryExpr(n, n, [&] {
                            return drawn(1, random, -1., 1.)(0);
                          })).householderQ();
    const VectorXd weights = VectorXd::NullaryExpr(n, [&](Eigen::Index i) { return std::pow(10., 3. * i / (n - 1.)); });
    vpCovarianceSearch search;
    search.generations = 3000;
    search.smallestStep = 1e-9;
    search.seed = vpTestSupport::seed();
    int calls = 0;
    const vpCovarianceSearch::Result found = search.run(VectorXd::Constant(n, 0.5), [&](const VectorXd &x) {
      ++calls;
      return (axes.transpose() * (x - least)).cwiseAbs2().dot(weights);
    });
    CAPTURE(n, found.evaluations, found.step);
    CHECK((found.x - least).norm() < 1e-5);
    CHECK(found.evaluations == calls);
    CHECK(found.value < 1e-10);
  }
}

TEST_CASE("A least value outside the cube is found on its border", "[search]")
{
  auto random = vpTestSupport::generator(732);
  CAPTURE(vpTestSupport::seed());
  VectorXd least = drawn(6, random, 0.2, 0.8);
  least(1) = 1.7;
  least(4) = -0.4;
  vpCovarianceSearch search;
  search.generations = 2000;
  search.seed = vpTestSupport::seed();
  double outermost = 0.;
  const vpCovarianceSearch::Result found = search.run(VectorXd::Constant(6, 0.5), [&](const VectorXd &x) {
    outermost = std::max(outermost, (x.array() - 0.5).abs().maxCoeff());
    return (x - least).squaredNorm();
  });
  CHECK(outermost <= 0.5); // never evaluated outside
  CHECK((found.x - least.cwiseMax(0.).cwiseMin(1.)).norm() < 1e-3);
}

TEST_CASE("The search repeats itself, survives NaN, and can be ended", "[search]")
{
  const auto f = [](const VectorXd &x) { return x(0) < 0.3 ? std::nan("") : x.squaredNorm(); };
  vpCovarianceSearch search;
  search.generations = 60;
  const VectorXd start = VectorXd::Constant(3, 0.6);
  const vpCovarianceSearch::Result a = search.run(start, f), b = search.run(start, f);
  CHECK(a.x == b.x);
  CHECK(a.x(0) >= 0.3);
  CHECK(a.value == a.x.squaredNorm());
  int generations = 0;
  static_cast<void>(search.run(start, f, [&](int, double) { return ++generations < 5; }));
  CHECK(generations == 5);
}

TEST_CASE("Wrong settings of the search are named", "[search]")
{
  const auto f = [](const VectorXd &x) { return x.sum(); };
  vpCovarianceSearch search;
  search.step = 0.;
  CHECK_THROWS_WITH(search.run(VectorXd::Constant(2, 0.5), f), Catch::Contains("step of the covariance search is 0"));
  search = vpCovarianceSearch();
  search.generations = 0;
  CHECK_THROWS_WITH(search.run(VectorXd::Constant(2, 0.5), f), Catch::Contains("generations of the covariance search"));
  search = vpCovarianceSearch();
  CHECK_THROWS_WITH(search.run(VectorXd::Constant(2, 1.5), f),
                    Catch::Contains("start of the covariance search is 1.5"));
}
