/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Radial distortion d (1 + kappa |d|^2) = w of (4.5) and (7.5): from the ideal position w to the observed one, d.
#ifndef vpCalibrationDistortion_h
#define vpCalibrationDistortion_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

struct vpDistortedPoint {
  Eigen::Vector2d d;        // observed position; NaN where the distortion has no inverse
  Eigen::Matrix2d byIdeal;  // derivative of d with respect to w
  Eigen::Vector2d byKappa1; // derivative of d with respect to kappa
};

[[nodiscard]] vpDistortedPoint vpDistort(const Eigen::Vector2d &ideal, double kappa1);

END_VISP_NAMESPACE
#endif
