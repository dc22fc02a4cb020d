/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTargetFrame.h"

#include <opencv2/imgproc.hpp>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t maxLevels = 5;
constexpr double smoothing = 1.;   // px; of noise, and so that the reference can be made as soft as the frame
constexpr int minSideToHalve = 48; // a smaller level would not hold the coarsest template any more
} // namespace

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

const vpKeypointSet &vpTargetFrame::keypoints(vpKeypointType type)
{
  Keypoints &entry = m_keypoints[type];
  if (!entry.extractor) {
    entry.extractor = makeKeypointExtractor(type, m_maxKeypoints);
  }
  if (!entry.valid) {
    entry.extractor->extract(m_image, entry.set);
    entry.valid = true;
  }
  return entry.set;
}

END_VISP_NAMESPACE
