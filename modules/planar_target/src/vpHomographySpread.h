/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpHomographySpread.h
 * \brief Internal: least-squares homography with its covariance, and the resulting uncertainty of a pixel.
 */
#ifndef vpHomographySpread_h
#define vpHomographySpread_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Pixels (u, v) of a reference of width x height are normalised to X = ((u - width/2)/S, (v - height/2)/S, 1), S
 * half the width; G maps X to pixels of the frame, G(2,2) = 1, and its other eight elements, row by row, have the
 * covariance C = s^2 (sum J^T J)^-1, s^2 = RSS / (2n - 8).
 */
struct vpHomographySpread {
  Eigen::Matrix3d G = Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();
  double sigma = 0.;  //!< s, px per axis.
  bool known = false; //!< False when the points do not determine a homography (nearly collinear).

  //! \param from, to : At least five pairs, px. \param start : Initial homography of pixels.
  vpHomographySpread(const std::vector<cv::Point2f> &from, const std::vector<cv::Point2f> &to, const cv::Mat &start,
                     double width, double height);
};

//! Derivative of the image of the normalised (x, y) under \e G with respect to the eight elements.
[[nodiscard]] Eigen::Matrix<double, 2, 8> homographyDerivative(const Eigen::Matrix3d &G, double x, double y);

END_VISP_NAMESPACE
#endif
