/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypointExtractor.h"

#include <visp3/core/vpException.h>

#include <opencv2/features2d.hpp>

BEGIN_VISP_NAMESPACE

namespace
{
// The default of 20 loses corners of a blurred or dim target; 15 keeps them, and the bound on their number holds.
constexpr int fastThreshold = 15;

class OpenCvExtractor : public vpKeypointExtractor
{
public:
  OpenCvExtractor(cv::Ptr<cv::Feature2D> feature, unsigned int maxKeypoints)
    : m_feature(std::move(feature)), m_maxKeypoints(maxKeypoints)
  {}

  void extract(const cv::Mat &image, vpKeypointSet &keypoints) override
  {
    m_feature->detect(image, m_found);
    cv::KeyPointsFilter::retainBest(m_found, static_cast<int>(m_maxKeypoints));
    m_feature->compute(image, m_found, keypoints.descriptors);
    cv::KeyPoint::convert(m_found, keypoints.points);
  }

private:
  cv::Ptr<cv::Feature2D> m_feature;
  unsigned int m_maxKeypoints;
  std::vector<cv::KeyPoint> m_found;
};
} // namespace

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
