/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSquarePose.h
 * \brief Pose of a square from its four corners, with covariance and the second pose that a plane has.
 */
#ifndef vpSquarePose_h
#define vpSquarePose_h

#include <visp3/direct_core/vpPoseCovariance.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <Eigen/Core>

#include <array>

BEGIN_VISP_NAMESPACE

//! A pose that fits the corners.
struct vpSquareFit {
  vpRigidTransform cMo;
  vpPoseCovariance covariance;
  double misfit = 0.; // sum of the squared residuals in standard deviations: chi-square with 2 degrees of freedom
  bool isValid = false;
};

//! The best pose of the square, and the other one, not valid where there is only one.
struct vpSquarePoses {
  vpSquareFit best, rival;
};

/*!
 * \brief Least squares from the pose of the homography, and from its reflection about the line of sight.
 * \param corners : Normalised, no distortion: top left, top right, bottom right, bottom left. \param size : Side, m.
 * \param sigma : Standard deviation of a normalised coordinate.
 */
vpSquarePoses vpFitSquare(const std::array<Eigen::Vector2d, 4> &corners, double size, double sigma);

END_VISP_NAMESPACE
#endif
