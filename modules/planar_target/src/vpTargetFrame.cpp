/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTargetFrame.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t maxLevels = 5;
constexpr double smoothing = 1.;   // px; against noise, and so that the reference can be made as soft as the frame
constexpr int minSideToHalve = 48; // a smaller level could not contain the coarsest template
} // namespace

vpTargetFrame::vpTargetFrame(unsigned int maxKeypoints, double pixelAspect)
  : m_maxKeypoints(maxKeypoints), m_stretchX(1. / std::sqrt(pixelAspect)), m_stretchY(std::sqrt(pixelAspect))
{
  constexpr double nearlySquare = 0.02;
  if (std::abs(pixelAspect - 1.) < nearlySquare) {
    m_stretchX = m_stretchY = 1.;
  }
}

void vpTargetFrame::assign(const vpImage<unsigned char> &image)
{
  for (auto &entry : m_keypoints) {
    entry.second.valid = false;
  }
  if (m_pyramid.empty()) {
    m_pyramid.emplace_back();
  }
  const cv::Mat view(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
  view.copyTo(m_image);
  m_square.release();
  cv::GaussianBlur(m_image, m_pyramid[0], cv::Size(5, 5), smoothing, 0., cv::BORDER_REPLICATE);
  std::size_t levels = 1;
  while (levels < maxLevels && std::min(m_pyramid[levels - 1].cols, m_pyramid[levels - 1].rows) >= minSideToHalve) {
    if (m_pyramid.size() == levels) {
      m_pyramid.emplace_back();
    }
    cv::pyrDown(m_pyramid[levels - 1], m_pyramid[levels]);
    ++levels;
  }
  m_pyramid.resize(levels);
}

vpKeypointExtractor &vpTargetFrame::extractor(vpKeypointType type)
{
  Keypoints &entry = m_keypoints[type];
  if (!entry.extractor) {
    entry.extractor = makeKeypointExtractor(type, m_maxKeypoints);
  }
  return *entry.extractor;
}

// In a part of the image with square pixels; positions are in the frame.
void vpTargetFrame::extract(vpKeypointType type, const cv::Rect &where, vpKeypointSet &set)
{
  extractor(type).extract(m_square(where), set);
  for (cv::Point2f &point : set.points) {
    point.x = static_cast<float>((point.x + where.x + 0.5) / m_stretchX - 0.5);
    point.y = static_cast<float>((point.y + where.y + 0.5) / m_stretchY - 0.5);
  }
}

void vpTargetFrame::makeSquare()
{
  if (!m_square.empty()) {
    return;
  }
  if (m_stretchX == 1.) {
    m_square = m_image;
  }
  else {
    cv::resize(m_image, m_square, cv::Size(), m_stretchX, m_stretchY, cv::INTER_LINEAR);
  }
}

const vpKeypointSet &vpTargetFrame::keypoints(vpKeypointType type)
{
  Keypoints &entry = m_keypoints[type];
  if (!entry.valid) {
    makeSquare();
    extract(type, cv::Rect(0, 0, m_square.cols, m_square.rows), entry.set);
    entry.valid = true;
  }
  return entry.set;
}

const vpKeypointSet &vpTargetFrame::keypointsOfPart(vpKeypointType type, unsigned int part)
{
  makeSquare();
  const int column = static_cast<int>(part % 3U), row = static_cast<int>(part / 3U % 3U);
  const cv::Size size(m_square.cols / 2, m_square.rows / 2);
  extract(type, cv::Rect(cv::Point(column * m_square.cols / 4, row * m_square.rows / 4), size), m_part);
  return m_part;
}

END_VISP_NAMESPACE
