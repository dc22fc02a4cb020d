/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoCheck.h
 * \brief Valid numbers for a law: finite, and within bounds that no camera or object exceeds.
 */
#ifndef vpServoCheck_h
#define vpServoCheck_h

#include "vpServoPose.h"

#include <visp3/feedforward/vpServoMeasurement.h>

#include <Eigen/LU>

#include <cmath>

BEGIN_VISP_NAMESPACE

// Every comparison is written so that NaN fails it.
namespace vpServoCheck
{
constexpr double largest = 1e6;  // m; also of x and y, which is 90 deg off the axis to within 1e-6
constexpr double nearest = 1e-9; // m, smallest depth

inline bool isPoint(const vpServoPoint &point)
{
  return std::abs(point.x) <= largest && std::abs(point.y) <= largest && point.Z >= nearest && point.Z <= largest;
}

inline bool isPose(const vpHomogeneousMatrix &M)
{
  const Eigen::Matrix3d R = vpServoPose::rotation(M);
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).squaredNorm() < 1e-6 && R.determinant() > 0. &&
         vpServoPose::translation(M).cwiseAbs().sum() <= largest;
}
} // namespace vpServoCheck

END_VISP_NAMESPACE
#endif
