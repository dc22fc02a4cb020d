/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpLookAt.h
 * \brief The orientation that keeps an object at its image position while the camera translates, and its rate.
 */
#ifndef vpLookAt_h
#define vpLookAt_h

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

/*!
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

END_VISP_NAMESPACE
#endif
