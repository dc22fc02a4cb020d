/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpBearing.h
 * \brief The bearing angle of an image point: the rotation vector that takes the optical axis to its ray.
 */
#ifndef vpBearing_h
#define vpBearing_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace vpBearing
{
//! atan(r) / r, accurate at r = 0.
inline double angleRatio(double r2)
{
  if (r2 < 1e-6) {
    return 1. - r2 / 3. + r2 * r2 / 5.;
  }
  const double r = std::sqrt(r2);
  return std::atan(r) / r;
}

//! th(x, y) = atan(r) / r (-y, x, 0), rad: a point to the right requires a rotation about +y, one below about -x.
inline Eigen::Vector3d angle(const Eigen::Vector2d &p)
{
  return angleRatio(p.squaredNorm()) * Eigen::Vector3d(-p.y(), p.x(), 0.);
}

//! d th / d (x, y).
inline Eigen::Matrix<double, 3, 2> jacobian(const Eigen::Vector2d &p)
{
  const double r2 = p.squaredNorm();
  const double ratio = angleRatio(r2);
  // d ratio / d r divided by r.
  const double slope = r2 < 1e-6 ? -2. / 3. + 4. / 5. * r2 : (1. / (1. + r2) - ratio) / r2;
  Eigen::Matrix<double, 3, 2> J;
  J << -slope * p.x() * p.y(), -ratio - slope * p.y() * p.y(), //
      ratio + slope * p.x() * p.x(), slope * p.x() * p.y(),    //
      0., 0.;
  return J;
}

//! c tanh(D / c) per axis: slope 1 at zero, bounded by c.
inline Eigen::Vector3d saturate(const Eigen::Vector3d &D, double c)
{
  return {c * std::tanh(D.x() / c), c * std::tanh(D.y() / c), c * std::tanh(D.z() / c)};
}

//! Derivative of saturate(), one factor per axis.
inline Eigen::Vector3d saturateSlope(const Eigen::Vector3d &D, double c)
{
  const Eigen::Array3d s = saturate(D, c).array() / c;
  return (1. - s * s).matrix();
}
} // namespace vpBearing

END_VISP_NAMESPACE
#endif
