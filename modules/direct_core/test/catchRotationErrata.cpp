/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Thesis (5.6) and (5.7): the printed formulas compared with vpSO3, on the same rotations. See doc/errata.md.
#include "vpCatch.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Geometry>

VISP_DIRECT_USING_NAMESPACE

namespace
{
Eigen::Vector3d randomDirection(std::mt19937_64 &rng)
{
  std::normal_distribution<double> gauss;
  return Eigen::Vector3d(gauss(rng), gauss(rng), gauss(rng)).normalized();
}

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
