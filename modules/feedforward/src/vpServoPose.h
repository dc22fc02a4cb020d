/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoPose.h
 * \brief ViSP's poses as fixed-size Eigen values: vpHomogeneousMatrix allocates on every product.
 */
#ifndef vpServoPose_h
#define vpServoPose_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/direct_core/vpTwist.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

namespace vpServoPose
{
inline Eigen::Matrix3d rotation(const vpHomogeneousMatrix &M)
{
  Eigen::Matrix3d R;
  R << M[0][0], M[0][1], M[0][2], M[1][0], M[1][1], M[1][2], M[2][0], M[2][1], M[2][2];
  return R;
}

inline Eigen::Vector3d translation(const vpHomogeneousMatrix &M) { return {M[0][3], M[1][3], M[2][3]}; }

//! cdMc as rotation and translation: R' = R [w]x and t' = R v under the camera twist (v, w).
struct Error {
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
};

//! cdMc = cdMo cMo^-1.
inline Error error(const vpHomogeneousMatrix &cdMo, const vpHomogeneousMatrix &cMo)
{
  Error e;
  e.R = rotation(cdMo) * rotation(cMo).transpose();
  e.t = translation(cdMo) - e.R * translation(cMo);
  return e;
}

inline vpTwist twist(const Eigen::Vector3d &v, const Eigen::Vector3d &w)
{
  return {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
}
} // namespace vpServoPose

END_VISP_NAMESPACE
#endif
