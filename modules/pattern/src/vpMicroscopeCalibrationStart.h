/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Step 1 of the planar calibration: closed-form initial values.
#ifndef vpMicroscopeCalibrationStart_h
#define vpMicroscopeCalibrationStart_h

#include <visp3/pattern/vpCalibrationPoint.h>

#include <Eigen/Core>

#include <vector>

BEGIN_VISP_NAMESPACE

// A view relative to the principal point and with square pixels: observed positions d and points of the plane p about
// its origin.
struct vpPlanarView {
  Eigen::Matrix2Xd d;     // px
  Eigen::Matrix2Xd p;     // m, y mirrored where the view is
  Eigen::Vector2d origin; // m, on the plane, before mirroring: the mean of the points
  bool mirrored = false;
};

[[nodiscard]] vpPlanarView vpMakePlanarView(const std::vector<vpCalibrationPoint> &points, double u0, double v0,
                                            double aspect);

// The direction cos, sin of the rotation, and the shift in px once the scale is known.
struct vpPlanarStart {
  double rotation = 0.;
  Eigen::Vector2d t = Eigen::Vector2d::Zero(); // m
};

// From the homogeneous radial alignment, or from an affine fit where that is not unique. Sets view.mirrored and mirrors
// p.
[[nodiscard]] vpPlanarStart vpStartPlanarView(vpPlanarView &view);

// (7.11) with the rows of u and v stacked: scale (px/m) and kappa1 (px^-2) from all views.
struct vpPlanarScale {
  double scale = 0.;
  double kappa1 = 0.;
};
[[nodiscard]] vpPlanarScale vpStartPlanarScale(const std::vector<vpPlanarView> &views,
                                               const std::vector<vpPlanarStart> &starts, bool withKappa1);

END_VISP_NAMESPACE
#endif
