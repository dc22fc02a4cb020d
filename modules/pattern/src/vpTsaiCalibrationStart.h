/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Step 1 of Tsai's calibration: closed-form pose and focal length of a view without distortion.
#ifndef vpTsaiCalibrationStart_h
#define vpTsaiCalibrationStart_h

#include <visp3/pattern/vpCalibrationPoint.h>

#include <Eigen/Core>

#include <vector>

BEGIN_VISP_NAMESPACE

// A pose as used by the solver: p in the camera = R (p - origin) + t, with the mean of the points as origin.
struct vpTsaiPose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

// Observed positions relative to the principal point with square pixels (px), points about their mean (m).
struct vpTsaiView {
  Eigen::Matrix2Xd d;
  Eigen::Matrix3Xd p;
  Eigen::Vector3d origin;
  bool planar = false;
  Eigen::Matrix3d axes; // of the points, longest first, right-handed
};
[[nodiscard]] vpTsaiView vpMakeTsaiView(const std::vector<vpCalibrationPoint> &points, double u0, double v0,
                                        double aspect);

// The poses allowed by the radial alignment (one for a body, two for a plane: its tilt has two signs), tz still zero.
// Empty when the points do not determine it.
[[nodiscard]] std::vector<vpTsaiPose> vpAlignTsaiView(const vpTsaiView &view);

// f (px) and tz (m) of a view by least squares, and their misfit. f = 0: estimate it, else it is given.
struct vpTsaiDepth {
  double f = 0.;
  double tz = 0.;
  double misfit = 0.;    // root mean square, px
  bool sensible = false; // f > 0 and all points in front of the camera
};
[[nodiscard]] vpTsaiDepth vpFindTsaiDepth(const vpTsaiView &view, const vpTsaiPose &pose, double f);

END_VISP_NAMESPACE
#endif
