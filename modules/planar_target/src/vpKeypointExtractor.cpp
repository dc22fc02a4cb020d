/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypointExtractor.h"

#include <visp3/core/vpException.h>

#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cstring>
#include <numeric>

BEGIN_VISP_NAMESPACE

namespace
{
// The default of 20 loses corners of a blurred or dim target; 15 keeps them, within the bound on their number.
constexpr int fastThreshold = 15;

class OpenCvExtractor : public vpKeypointExtractor
{
public:
  OpenCvExtractor(cv::Ptr<cv::Feature2D> feature, unsigned int maxKeypoints)
    : m_feature(std::move(feature)), m_maxKeypoints(maxKeypoints)
  {}

  void extract(const cv::Mat &image, vpKeypointSet &keypoints) override
  {
    // Detection and description together: AKAZE, KAZE and SIFT would build their scale space twice.
    m_feature->detectAndCompute(image, cv::noArray(), m_found, m_descriptors);
    m_order.resize(m_found.size());
    std::iota(m_order.begin(), m_order.end(), 0);
    std::stable_sort(m_order.begin(), m_order.end(), [this](int a, int b) {
      return m_found[static_cast<std::size_t>(a)].response > m_found[static_cast<std::size_t>(b)].response;
    });
    m_order.resize(std::min<std::size_t>(m_order.size(), m_maxKeypoints));
    keypoints.points.clear();
    keypoints.descriptors.create(static_cast<int>(m_order.size()), m_descriptors.cols, m_descriptors.type());
    for (std::size_t i = 0; i < m_order.size(); ++i) {
      keypoints.points.push_back(m_found[static_cast<std::size_t>(m_order[i])].pt);
      m_descriptors.row(m_order[i]).copyTo(keypoints.descriptors.row(static_cast<int>(i)));
    }
    keypoints.pack();
  }

private:
  cv::Ptr<cv::Feature2D> m_feature;
  unsigned int m_maxKeypoints;
  std::vector<cv::KeyPoint> m_found;
  std::vector<int> m_order; // indices of m_found, by strength
  cv::Mat m_descriptors;
};
} // namespace

std::size_t vpKeypointSet::words() const
{
  return (static_cast<std::size_t>(descriptors.cols) * descriptors.elemSize() + 31) / 32 * 4;
}

void vpKeypointSet::pack()
{
  packed.clear();
  if (descriptors.empty() || descriptors.depth() != CV_8U) {
    return;
  }
  const std::size_t n = static_cast<std::size_t>(descriptors.rows);
  std::vector<std::uint64_t> row(words(), 0); // padded with zeros: AKAZE has 61 bytes
  packed.resize(n * row.size());
  for (std::size_t i = 0; i < n; ++i) {
    std::memcpy(row.data(), descriptors.ptr(static_cast<int>(i)), static_cast<std::size_t>(descriptors.cols));
    for (std::size_t k = 0; k < row.size(); ++k) {
      packed[k * n + i] = row[k];
    }
  }
}

std::unique_ptr<vpKeypointExtractor> makeKeypointExtractor(vpKeypointType type, unsigned int maxKeypoints)
{
  cv::Ptr<cv::Feature2D> feature;
  switch (type) {
  case vpKeypointType::ORB:
    feature =
        cv::ORB::create(static_cast<int>(maxKeypoints), 1.2f, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31, fastThreshold);
    break;
  case vpKeypointType::SIFT:
    feature = cv::SIFT::create(static_cast<int>(maxKeypoints));
    break;
  case vpKeypointType::AKAZE:
    feature = cv::AKAZE::create();
    break;
  case vpKeypointType::KAZE:
    feature = cv::KAZE::create();
    break;
  case vpKeypointType::BRISK:
    feature = cv::BRISK::create();
    break;
  case vpKeypointType::SURF:
    return makeSurfExtractor(maxKeypoints);
  }
  if (!feature) {
    throw vpException(vpException::badValue, "keypoint type %d is not known", static_cast<int>(type));
  }
  return std::make_unique<OpenCvExtractor>(feature, maxKeypoints);
}

END_VISP_NAMESPACE
