/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTargetPrediction.h
 * \brief Internal: predicted image of the target in the frame, pixel by pixel, with derivatives.
 */
#ifndef vpTargetPrediction_h
#define vpTargetPrediction_h

#include "vpGreyLanes.h"
#include "vpPlaneGeometry.h"

#include <opencv2/core.hpp>

BEGIN_VISP_NAMESPACE

//! The reference as grey values, each level the means of 2x2 pixels of the one before.
class vpTargetTexture
{
public:
  static constexpr int scale = vpGreyTextureRow::scale; //!< of the stored grey values, CV_16U

  //! \param reference : CV_8UC1.
  vpTargetTexture(const cv::Mat &reference, const vpTargetPlane &plane);
  //! The coarsest level with a texel of at most 0.6 pixels at this pose: finer than the frame, if the reference is.
  [[nodiscard]] const cv::Mat &at(const vpRigidPose &pose, const vpPinhole &camera) const;

private:
  vpTargetPlane m_plane;
  std::vector<cv::Mat> m_levels;
};

/*!
 * Predicted image of the target on a rectangle of whole pixels: the texture, sampled twice per pixel each way, mean
 * over the pixel, Gaussian blur in the frame. The kernel acts in the frame, so tilt and distance do not change its
 * shape, and all derivatives are taken on the samples, twice as fine as the pixels.
 */
class vpTargetPrediction
{
public:
  static constexpr int lanes = 8;          //!< columns are a multiple of it, for the loops over them
  static constexpr double sharpest = 0.1;  //!< px; smaller values have no effect next to the pixel size
  static constexpr double softest = 4.;    //!< px
  static constexpr int fewestPixels = 200; //!< to fit six parameters of a pose and three of the camera

  static constexpr int enoughToThin = 20000; //!< pixels of a large target, see predict()

  //! Pixels of one row that are certainly on the target, columns from the rectangle's left.
  struct Span {
    int begin = 0, end = 0;
  };

  explicit vpTargetPrediction(const vpTargetPlane &plane) : m_plane(plane) {}

  /*!
   * \param size : Size of the frame, px. \param blur : Standard deviation of the Gaussian, px, within sharpest and
   *   softest.
   * \param sparse : From enoughToThin pixels on, every third row of blocks only; the other spans are empty.
   * \return False if fewer than fewestPixels pixels are on the target.
   */
  bool predict(const vpTargetTexture &texture, const vpRigidPose &pose, const vpPinhole &camera, cv::Size size,
               double blur, bool sparse = false);

  [[nodiscard]] const cv::Rect &area() const { return m_area; } //!< in the frame; wider than it by less than lanes
  [[nodiscard]] const std::vector<Span> &spans() const { return m_spans; } //!< one for each row
  [[nodiscard]] int pixels() const { return m_pixels; }                    //!< in all spans
  //! Grey values and their derivatives with respect to u, v (per px), and half the squared blur (per px^2); CV_32F.
  //! Beyond the spans: old values, finite, up to whole blocks of lanes x lanes.
  [[nodiscard]] const cv::Mat &grey() const { return m_grey; }
  [[nodiscard]] const cv::Mat &du() const { return m_du; }       //!< see grey()
  [[nodiscard]] const cv::Mat &dv() const { return m_dv; }       //!< see grey()
  [[nodiscard]] const cv::Mat &dBlur() const { return m_dBlur; } //!< see grey()

private:
  struct Kernel;
  void thin();
  bool findArea(const vpRigidPose &pose, const vpPinhole &camera, cv::Size size, double margin);
  void sampleRow(const vpGreyLanes &loops, vpGreyTextureRow &row, double v, int begin, int end);
  void filterRow(const vpGreyLanes &loops, const Kernel &kernel, int begin, int end, int row);
  void filterColumns(const vpGreyLanes &loops, const Kernel &kernel, int row);

  vpTargetPlane m_plane;
  cv::Rect m_area;
  std::vector<Span> m_spans;
  int m_pixels = 0;
  cv::Mat m_grey, m_du, m_dv, m_dBlur;
  std::vector<float> m_left, m_right;     //!< the samples in the left and in the right half of each pixel of a row
  cv::Mat m_smooth, m_slope, m_curvature; //!< rows of samples, filtered along the row; a ring
};

//! Derivative of the pixel that shows the target at (u, v) with respect to (v, w) of the pose: R = exp(w) R, t += v.
[[nodiscard]] Eigen::Matrix<double, 2, 6> pixelMotion(const vpRigidPose &pose, const vpPinhole &camera, double u,
                                                      double v);

//! Displacement of a pixel (u, v) that shows the target at pose \e from when the pose changes to \e to, px.
[[nodiscard]] Eigen::Vector2d pixelShift(const vpRigidPose &from, const vpRigidPose &to, const vpPinhole &camera,
                                         double u, double v);

END_VISP_NAMESPACE
#endif
