/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoGeometry.h
 * \brief Angles of a pose, as used in the log and the metrics of an experiment.
 */
#ifndef vpServoGeometry_h
#define vpServoGeometry_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpSO3.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace vpServoGeometry
{
//! Rotation part of \e M.
inline Eigen::Matrix3d rotation(const vpHomogeneousMatrix &M)
{
  Eigen::Matrix3d R;
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      R(r, c) = M[r][c];
    }
  }
  return R;
}

//! Direction of the optical axis in the world's x-z plane, rad: 0 along z, positive towards x.
inline double yaw(const Eigen::Matrix3d &wRc) { return std::atan2(wRc(0, 2), wRc(2, 2)); }

//! Length of the translation of \e M, m.
inline double distance(const vpHomogeneousMatrix &M)
{
  return std::sqrt(M[0][3] * M[0][3] + M[1][3] * M[1][3] + M[2][3] * M[2][3]);
}
} // namespace vpServoGeometry

END_VISP_NAMESPACE
#endif
