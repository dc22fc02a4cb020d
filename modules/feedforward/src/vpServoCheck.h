/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoCheck.h
 * \brief What a law may compute with: finite, and within bounds beyond which there is no camera and no object.
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
constexpr double largest = 1e6;  // m; and of x and y, which is 90 deg off the axis but for a millionth
constexpr double nearest = 1e-9; // m, of a depth

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
