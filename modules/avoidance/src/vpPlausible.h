/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Checks of validity and plausible magnitude. False for NaN.
#ifndef vpPlausible_h
#define vpPlausible_h

#include <visp3/manipulator/vpArmTypes.h>

#include <Eigen/LU>

#include <cmath>

BEGIN_VISP_NAMESPACE

//! True for a rotation (to 1e-6) and any finite translation.
inline bool vpIsRigid(const vpRigidTransform &T)
{
  return T.p.allFinite() && T.R.allFinite() &&
         (T.R * T.R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 && T.R.determinant() > 0.;
}

//! True for a rotation and a translation within vpLargestLength.
inline bool vpIsPlace(const vpRigidTransform &T)
{
  return vpIsRigid(T) && (T.p.cwiseAbs().array() <= vpLargestLength).all();
}

//! True for a time of at most 1e11 s, before or after 0.
inline bool vpIsTime(double time) { return std::fabs(time) <= 1e11; }

END_VISP_NAMESPACE
#endif
