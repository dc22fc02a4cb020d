/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFeedforwardErrors.h
 * \brief Which way the camera should turn to keep an object in view: bearing angles, and the look-at orientation.
 */
#ifndef vpFeedforwardErrors_h
#define vpFeedforwardErrors_h

#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/feedforward/vpServoMeasurement.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

BEGIN_VISP_NAMESPACE

// The bearing angle of an image point: the rotation vector that takes the optical axis to its ray.
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

} // namespace vpBearing

/*!
 * \brief Rotation error of `ff-sum`, e = theta u - kappa c tanh(D / c), D = th(p) - th(p*), rad (thesis (5.26)-(5.28),
 * corrected): p and p* are the means of the points that are visible both now and in the goal.
 */
struct vpFeedforwardSum {
  bool defined = false; //!< False when there is no such point.
  Eigen::Vector3d e = Eigen::Vector3d::Zero();

  //! \param R : Rotation of cdMc. \param points, goal : Of equal number.
  vpFeedforwardSum(const Eigen::Matrix3d &R, const std::vector<vpServoPoint> &points,
                   const std::vector<vpServoPoint> &goal, const vpServoGains &gains)
  {
    Eigen::Vector2d p(0., 0.), goalP(0., 0.);
    double count = 0.;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].visible && goal[i].visible) {
        p += Eigen::Vector2d(points[i].x, points[i].y);
        goalP += Eigen::Vector2d(goal[i].x, goal[i].y);
        ++count;
      }
    }
    defined = count > 0.;
    if (defined) {
      const Eigen::Vector3d D = vpBearing::angle(p / count) - vpBearing::angle(goalP / count);
      e = vpSO3::log(R) - gains.kappa * vpBearing::saturate(D, gains.saturation);
    }
  }
};

/*!
 * \brief The orientation that keeps an object at its image position while the camera translates, and its rate.
 *
 * With O* the object's origin in the desired camera frame and t the camera's position in it, d = O* - t points from the
 * camera to the object, and R_la is the rotation of smallest angle from d* = O* to d. A camera with that orientation
 * sees the object in the direction d*, as the desired camera does.
 */
struct vpLookAt {
  bool
      defined; //!< False when the camera is at the object's origin or looks from the opposite side, or invalid numbers.
  Eigen::Matrix3d rotation; //!< R_la, in the desired camera frame.
  /*!
   * Spatial angular velocity of R_la, in the desired camera frame, per d'. Of all rates with n' = rate x n, with n = d
   * / |d|, it is the one that keeps R_la minimal: its part along n + n* is zero. (A quaternion (w, u) of a minimal
   * rotation from n* has u . n* = 0; its derivative gives rate . (w n* + u x n*) = 0, and that bracket is along n +
   * n*.) Hence rate = n x n' - n (n* . (n x n')) / (1 + n . n*).
   */
  Eigen::Matrix3d rate;

  vpLookAt(const Eigen::Vector3d &origin, const Eigen::Vector3d &t) : defined(false)
  {
    const Eigen::Vector3d d = origin - t;
    const double length = d.norm(), goalLength = origin.norm();
    // Closer than a tenth of a millimetre, or within 0.1 deg of the opposite side, the direction is noise. Comparisons
    // are written so that NaN and overflows fail them.
    if (!(length > 1e-4 && goalLength > 1e-4 && length < 1e9 && goalLength < 1e9)) {
      return;
    }
    const Eigen::Vector3d n = d / length, goal = origin / goalLength;
    const double onePlusCos = 1. + n.dot(goal);
    if (!(onePlusCos > 1e-6)) {
      return;
    }
    defined = true;
    rotation = vpSO3::minimalRotation(goal, n);
    rate = (Eigen::Matrix3d::Identity() - n * goal.transpose() / onePlusCos) * vpSO3::skew(n) / length;
  }
};

//! Interaction matrix of an image point: (x, y)' = L (v, w).
inline Eigen::Matrix<double, 2, 6> vpPointInteraction(const vpServoPoint &p)
{
  const double inverseZ = 1. / p.Z;
  Eigen::Matrix<double, 2, 6> L;
  L << -inverseZ, 0., p.x * inverseZ, p.x * p.y, -1. - p.x * p.x, p.y, //
      0., -inverseZ, p.y * inverseZ, 1. + p.y * p.y, -p.x * p.y, -p.x;
  return L;
}

END_VISP_NAMESPACE
#endif
