/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPhotometricModel.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int border = 3;        // px left out: one for the gradient, two for the smoothing of the frame
constexpr int smallestSide = 24; // of the coarsest level, px

vpPhotometricLevel makeLevel(const cv::Mat &image, const vpTargetPlane &plane, double unit)
{
  vpPhotometricLevel level;
  level.cols = image.cols - 2 * border;
  level.rows = image.rows - 2 * border;
  level.pitchX = plane.width / image.cols / unit;
  level.pitchY = plane.height / image.rows / unit;
  level.firstX = (border + 0.5 - 0.5 * image.cols) * level.pitchX;
  level.firstY = (border + 0.5 - 0.5 * image.rows) * level.pitchY;
  level.samples.reserve(static_cast<std::size_t>(level.cols) * static_cast<std::size_t>(level.rows));
  for (int v = border; v < image.rows - border; ++v) {
    for (int u = border; u < image.cols - border; ++u) {
      const double gu = 0.5 * (image.at<float>(v, u + 1) - image.at<float>(v, u - 1));
      const double gv = 0.5 * (image.at<float>(v + 1, u) - image.at<float>(v - 1, u));
      level.samples.push_back({image.at<float>(v, u), static_cast<float>(gu / level.pitchX),
                               static_cast<float>(gv / level.pitchY), static_cast<float>(gu * gu + gv * gv)});
    }
  }
  double sum = 0.;
  for (const vpPhotometricSample &s : level.samples) {
    sum += s.slope2;
  }
  level.textured = static_cast<float>(0.25 * sum / static_cast<double>(level.samples.size()));
  return level;
}
} // namespace

vpPhotometricModel::vpPhotometricModel(const cv::Mat &reference, const vpTargetPlane &plane, int finestSize)
  : m_unit(0.5 * std::max(plane.width, plane.height))
{
  cv::Mat source, image, soft;
  reference.convertTo(source, CV_32F);
  double scale = std::min(1., static_cast<double>(finestSize) / std::max(reference.cols, reference.rows));
  do {
    const cv::Size size(static_cast<int>(std::lround(scale * reference.cols)),
                        static_cast<int>(std::lround(scale * reference.rows)));
    cv::resize(source, image, size, 0., 0., cv::INTER_AREA);
    if (m_levels[0].empty()) {
      cv::Scalar mean, deviation;
      cv::meanStdDev(image, mean, deviation);
      m_contrast = deviation[0];
    }
    for (std::size_t i = 0; i < softness.size(); ++i) {
      cv::GaussianBlur(image, soft, cv::Size(), softness[i], 0., cv::BORDER_REPLICATE);
      m_levels[i].push_back(makeLevel(soft, plane, m_unit));
    }
    scale *= 0.5;
  } while (scale * std::min(reference.cols, reference.rows) >= smallestSide);
}

END_VISP_NAMESPACE
