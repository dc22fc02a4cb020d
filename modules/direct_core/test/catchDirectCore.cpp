/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpWildNumbers.h"

#include <visp3/core/vpThetaUVector.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/direct_core/vpTwist.h>

#include <Eigen/Geometry>

VISP_DIRECT_USING_NAMESPACE

namespace
{
Eigen::Vector3d randomDirection(std::mt19937_64 &rng)
{
  std::normal_distribution<double> gauss;
  Eigen::Vector3d v(gauss(rng), gauss(rng), gauss(rng));
  return v.normalized();
}

// Angles where formulas break: zero, tiny, the switch to series, right angles, near and at pi.
const double criticalAngles[] = {0., 1e-12, 1e-9, 1e-6, 0.0099, 0.0101, 1., M_PI / 2., 3., M_PI - 1e-6, M_PI - 1e-10};
} // namespace

TEST_CASE("exp and log are inverse at every angle", "[so3]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> angle(0., M_PI);
  for (int i = 0; i < 5000; ++i) {
    const double theta = i < 1100 ? criticalAngles[i % 11] : angle(rng);
    const Eigen::Vector3d e = theta * randomDirection(rng);
    const Eigen::Matrix3d R = vpSO3::exp(e);
    CAPTURE(theta, e.transpose());
    REQUIRE((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    REQUIRE((R - Eigen::AngleAxisd(theta, theta > 0. ? Eigen::Vector3d(e / theta) : Eigen::Vector3d::UnitX()).matrix())
                .norm() < 1e-14);
    REQUIRE((vpSO3::log(R) - e).norm() < 1e-13 + 1e-7 * (theta > M_PI - 1e-8));
  }
}

TEST_CASE("log agrees with vpThetaUVector", "[so3]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> angle(0.01, 3.1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d e = angle(rng) * randomDirection(rng);
    const Eigen::Matrix3d R = vpSO3::exp(e);
    vpRotationMatrix M;
    for (unsigned int r = 0; r < 3; ++r) {
      for (unsigned int c = 0; c < 3; ++c) {
        M[r][c] = R(r, c);
      }
    }
    const vpThetaUVector tu(M);
    REQUIRE((vpSO3::log(R) - Eigen::Vector3d(tu[0], tu[1], tu[2])).norm() < 1e-9);
  }
}

TEST_CASE("right Jacobian equals finite differences and its inverse", "[so3]")
{
  auto rng = vpTestSupport::generator(3);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> angle(0., M_PI - 1e-3);
  const double h = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const double theta = i < 800 ? criticalAngles[i % 8] : angle(rng);
    const Eigen::Vector3d e = theta * randomDirection(rng);
    const Eigen::Matrix3d J = vpSO3::rightJacobian(e);
    CAPTURE(theta);
    REQUIRE((J * vpSO3::rightJacobianInverse(e) - Eigen::Matrix3d::Identity()).norm() < 1e-12);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(k);
      const Eigen::Vector3d rate = vpSO3::log(vpSO3::exp(e - d).transpose() * vpSO3::exp(e + d)) / (2. * h);
      REQUIRE((rate - J.col(k)).norm() < 1e-9);
    }
  }
}

TEST_CASE("minimal rotation takes one direction to the other about their common normal", "[so3]")
{
  auto rng = vpTestSupport::generator(4);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> exponent(-17., 0.5), length(-300., 300.);
  for (int i = 0; i < 6000; ++i) {
    // A third each: any angle, nearly the same, nearly opposite (down to the last digit, and exactly).
    const Eigen::Vector3d a = randomDirection(rng);
    const double sign = i % 3 == 1 ? 1. : -1., apart = i % 300 < 3 ? 0. : std::pow(10., exponent(rng));
    const Eigen::Vector3d near = (sign * a + apart * a.unitOrthogonal()).normalized();
    const Eigen::Vector3d b = i % 3 == 0 ? randomDirection(rng) : near;
    const Eigen::Matrix3d R = vpSO3::minimalRotation(std::pow(10., length(rng)) * a, std::pow(10., length(rng)) * b);
    CAPTURE(i, a.transpose(), b.transpose());
    // R is a rotation and maps a to b, to a few roundings of products of numbers up to 1.
    REQUIRE((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 4e-15);
    REQUIRE(R.determinant() > 0.);
    REQUIRE((R * a - b).norm() < 4e-15);
    // Minimal: its angle is the one between them. atan2 and log() lose no digits at either end.
    REQUIRE(std::abs(vpSO3::log(R).norm() - std::atan2(a.cross(b).norm(), a.dot(b))) < 4e-15);
  }
  for (const double bad : {0., -0., static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    CHECK_FALSE(vpSO3::minimalRotation({bad, 0., 0.}, {0., 0., 1.}).allFinite()); // no direction, NaN
    CHECK_FALSE(vpSO3::minimalRotation({0., 0., 1.}, {0., bad, 0.}).allFinite());
  }
}

TEST_CASE("the length and the limit of a twist hold for every number", "[twist][wild]")
{
  auto rng = vpTestSupport::generator(5);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 8> x;
    for (double &number : x) {
      number = vpWildNumbers::mixed(rng, gauss(rng), 0.3);
    }
    CAPTURE(i, x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]);
    const vpTwist v(x[0], x[1], x[2], x[3], x[4], x[5]);
    if (v.isFinite()) {
      const long double length =
          std::sqrt(static_cast<long double>(x[0]) * x[0] + static_cast<long double>(x[1]) * x[1] +
                    static_cast<long double>(x[2]) * x[2]); // does not overflow
      REQUIRE((v.linearNorm() == Approx(static_cast<double>(length)).epsilon(1e-15).margin(1e-323) ||
               v.linearNorm() == static_cast<double>(length)));
    }
    const vpTwist limited = vpLimitTwist(v, x[6], x[7]);
    REQUIRE(limited.isFinite());
    // Denormals have fewer digits: three components with an error of one unit.
    const double least = 3. * std::numeric_limits<double>::denorm_min();
    REQUIRE((limited.linearNorm() <= least || vpWildNumbers::atMost(limited.linearNorm(), x[6], 3e-15)));
    REQUIRE((limited.angularNorm() <= least || vpWildNumbers::atMost(limited.angularNorm(), x[7], 3e-15)));
  }
  CHECK(std::isnan(vpTwist(0., NAN, 0., 0., 0., 0.).linearNorm()));
  CHECK(vpTwist(0., 0., 0., 1e200, 1e200, 0.).angularNorm() == Approx(std::sqrt(2.) * 1e200));
}

TEST_CASE("twist converts, limits uniformly and rejects wrong sizes", "[twist]")
{
  const vpTwist v(3., 0., 4., 0., 0., 1.);
  const vpTwist limited = vpLimitTwist(v, 1., 10.);
  CHECK(limited.linearNorm() == Approx(1.));
  CHECK(limited[5] == Approx(0.2)); // one factor for all six components
  CHECK(vpLimitTwist(v, 5., 1.)[0] == 3.);
  CHECK(vpTwist::fromColVector(v.toColVector())[2] == 4.);
  CHECK_FALSE(vpTwist(0., NAN, 0., 0., 0., 0.).isFinite());
  CHECK_THROWS_WITH(vpTwist::fromColVector(vpColVector(5)),
                    Catch::Contains("a twist has 6 components, got a vector of 5"));
}

TEST_CASE("rotation kernel and twist allocate nothing", "[so3][twist][realtime]")
{
  if (!vpTestSupport::canCountAllocations()) {
    WARN("allocations cannot be counted in this build");
    return;
  }
  double sink = 0.;
  const Eigen::Vector3d e(0.3, -0.2, 0.9);
  vpColVector column(6);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d R = vpSO3::exp(e * i * 0.03);
    sink += vpSO3::log(R).x() + vpSO3::rightJacobianInverse(e)(0, 1) +
            vpLimitTwist(vpTwist(1., 2., 3., 4., 5., 6.), 1., 1.)[0];
    vpTwist(1., 2., 3., 4., 5., sink).copyTo(column);
  }
  REQUIRE(vpTestSupport::allocationCount() == before);
  REQUIRE(std::isfinite(sink));
}

// Thesis (5.6) and (5.7): the printed formulas compared with vpSO3, on the same rotations. See doc/errata.md.
namespace
{
// (5.6) with selectable sign of its second term; sinc as defined in the text.
Eigen::Matrix3d interaction(const Eigen::Vector3d &e, double sign)
{
  const double theta = e.norm();
  const Eigen::Matrix3d u = vpSO3::skew(e / theta);
  const auto sinc = [](double x) { return std::sin(x) / x; };
  return Eigen::Matrix3d::Identity() + sign * 0.5 * theta * u +
         (1. - sinc(theta) / (sinc(0.5 * theta) * sinc(0.5 * theta))) * u * u;
}

// (5.7) as printed.
Eigen::Vector3d printedLog(const Eigen::Matrix3d &R)
{
  const double theta = std::acos(0.5 * (R.trace() - 1.));
  return theta / (2. * std::sin(theta)) * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}
} // namespace

TEST_CASE("(5.6) has the sign of the inverse rotation as printed, and the other one is right for cdMc", "[errata]")
{
  auto rng = vpTestSupport::generator(41);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> angle(0.2, 3.);
  const double h = 1e-6;
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3d e = angle(rng) * randomDirection(rng), w = randomDirection(rng);
    // A camera that rotates with w moves cdRc to cdRc exp(w t): Eigen's angle and axis, an independent formula.
    const auto thetaU = [&](double t) {
      const Eigen::AngleAxisd turned(Eigen::AngleAxisd(e.norm(), e.normalized()).toRotationMatrix() *
                                     Eigen::AngleAxisd(t, w).toRotationMatrix());
      return Eigen::Vector3d(turned.angle() * turned.axis());
    };
    const Eigen::Vector3d rate = (thetaU(h) - thetaU(-h)) / (2. * h);
    CAPTURE(e.transpose(), w.transpose());
    REQUIRE((vpSO3::rightJacobianInverse(e) * w - rate).norm() < 1e-6);
    REQUIRE((interaction(e, 1.) * w - rate).norm() < 1e-6);
    // The two differ by theta |u x w|.
    REQUIRE((interaction(e, -1.) * w - rate).norm() > e.cross(w).norm() - 1e-6);
  }
}

TEST_CASE("(5.7) as printed loses small rotations and those near pi", "[errata]")
{
  auto rng = vpTestSupport::generator(42);
  CAPTURE(vpTestSupport::seed());
  for (const double theta : {1e-9, M_PI - 1e-9}) {
    double printed = 0., ours = 0.;
    for (int k = 0; k < 100; ++k) {
      const Eigen::Vector3d e = theta * randomDirection(rng);
      const Eigen::Matrix3d R = Eigen::AngleAxisd(theta, e.normalized()).toRotationMatrix();
      const double off = (printedLog(R) - e).norm() / theta;
      printed = std::max(printed, std::isfinite(off) ? off : 1.); // 0/0 where the cosine is rounded to 1
      ours = std::max(ours, (vpSO3::log(R) - e).norm() / theta);
    }
    CAPTURE(theta);
    CHECK(printed > 0.01);
    CHECK(ours < 1e-7);
  }
}
