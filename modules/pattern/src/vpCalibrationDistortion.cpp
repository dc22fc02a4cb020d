/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCalibrationDistortion.h"

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
// r with r (1 + kappa r^2) = rho, on the branch that begins at zero; NaN beyond its end.
double seenRadius(double rho, double kappa)
{
  if (kappa < 0. && rho > 2. / (3. * std::sqrt(-3. * kappa))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  // Newton from the side where the curve bends towards the root, so that it converges monotonically.
  double r = kappa < 0. ? rho : std::min(rho, std::cbrt(rho / kappa));
  for (int i = 0; i < 60; ++i) {
    const double slope = 1. + 3. * kappa * r * r;
    const double step = (rho - r * (1. + kappa * r * r)) / slope;
    if (!std::isfinite(step)) {
      break;
    }
    r += step;
    if (std::abs(step) <= 1e-15 * r) {
      break;
    }
  }
  return r;
}
} // namespace

vpDistortedPoint vpDistort(const Eigen::Vector2d &ideal, double kappa1)
{
  vpDistortedPoint point;
  const double rho = ideal.norm();
  if (kappa1 == 0. || rho == 0.) {
    point.d = ideal;
    point.byIdeal.setIdentity();
    point.byKappa1 = -rho * rho * ideal;
    return point;
  }
  const double r = seenRadius(rho, kappa1);
  const double slope = 1. / (1. + 3. * kappa1 * r * r), share = r / rho;
  const Eigen::Vector2d direction = ideal / rho;
  point.d = share * ideal;
  point.byIdeal = share * Eigen::Matrix2d::Identity() + (slope - share) * direction * direction.transpose();
  point.byKappa1 = -slope * r * r * r * direction;
  return point;
}

END_VISP_NAMESPACE
