/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/planar_target/vpPlaneMatcher.h>

#include "vpKeypointMatcher.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>

#include <opencv2/calib3d.hpp>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr unsigned int smallestImage = 32; // px
constexpr float loweRatio = 0.8f;

cv::Mat view(const vpImage<unsigned char> &image)
{
  return cv::Mat(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
}
} // namespace

class vpPlaneMatcher::Impl
{
public:
  Impl(const vpImage<unsigned char> &reference, const vpPlanarTargetConfig &config) : m_config(config)
  {
    config.validate();
    if (reference.getWidth() < smallestImage || reference.getHeight() < smallestImage) {
      throw vpException(vpException::dimensionError, "reference image is %ux%u px, must be at least %ux%u",
                        reference.getWidth(), reference.getHeight(), smallestImage, smallestImage);
    }
    m_extractor = makeKeypointExtractor(config.keypoints, config.maxKeypoints);
    m_extractor->extract(view(reference), m_reference);
    if (m_reference.points.size() < config.minInliers) {
      throw vpException(
          vpException::badValue, "reference image has too little texture: %u %s keypoints, at least %u are needed",
          static_cast<unsigned int>(m_reference.points.size()), toString(config.keypoints), config.minInliers);
    }
    m_result.referenceKeypoints = m_reference.points.size();
  }

  void match(const vpImage<unsigned char> &image)
  {
    m_result = vpPlaneMatch();
    m_result.referenceKeypoints = m_reference.points.size();
    if (image.getWidth() < smallestImage || image.getHeight() < smallestImage) {
      fail(vpPlanarTargetStatus::NoTexture, "The image is " + std::to_string(image.getWidth()) + "x" +
                                                std::to_string(image.getHeight()) + " px, at least 32x32 are needed.");
      return;
    }
    m_extractor->extract(view(image), m_current);
    m_result.frameKeypoints = m_current.points.size();
    if (m_current.points.size() < m_config.minInliers) {
      fail(vpPlanarTargetStatus::NoTexture, "The image has " + std::to_string(m_current.points.size()) +
                                                " keypoints, at least " + std::to_string(m_config.minInliers) +
                                                " are needed.");
      return;
    }
    std::vector<cv::Point2f> from, to;
    for (const auto &pair : matchKeypoints(m_reference, m_current, loweRatio)) {
      from.push_back(m_reference.points[static_cast<std::size_t>(pair.first)]);
      to.push_back(m_current.points[static_cast<std::size_t>(pair.second)]);
    }
    m_result.matches = from.size();
    std::vector<unsigned char> mask;
    cv::Mat H;
    if (from.size() >= m_config.minInliers) {
      H = cv::findHomography(from, to, cv::USAC_MAGSAC, m_config.inlierThreshold, mask, 5000, 0.999);
    }
    for (std::size_t i = 0; !H.empty() && i < from.size(); ++i) {
      if (mask[i]) {
        m_result.inliers.emplace_back(vpImagePoint(from[i].y, from[i].x), vpImagePoint(to[i].y, to[i].x));
      }
    }
    if (m_result.inliers.size() < m_config.minInliers) {
      fail(vpPlanarTargetStatus::TooFewInliers,
           std::to_string(m_result.inliers.size()) + " of " + std::to_string(from.size()) +
               " matches agree on one plane, at least " + std::to_string(m_config.minInliers) + " must.");
      return;
    }
    for (int i = 0; i < 9; ++i) {
      m_result.homography[static_cast<std::size_t>(i)] = H.at<double>(i / 3, i % 3) / H.at<double>(2, 2);
    }
    m_result.status = vpPlanarTargetStatus::Acquired;
    m_result.message =
        std::to_string(m_result.inliers.size()) + " of " + std::to_string(from.size()) + " matches agree.";
  }

  vpPlaneMatch m_result;

private:
  void fail(vpPlanarTargetStatus status, const std::string &message)
  {
    m_result.status = status;
    m_result.message = message;
  }

  vpPlanarTargetConfig m_config;
  std::unique_ptr<vpKeypointExtractor> m_extractor;
  vpKeypointSet m_reference, m_current;
};

vpPlaneMatcher::vpPlaneMatcher(const vpImage<unsigned char> &reference, const vpPlanarTargetConfig &config)
  : m_impl(std::make_unique<Impl>(reference, config))
{}

vpPlaneMatcher::~vpPlaneMatcher() = default;
vpPlaneMatcher::vpPlaneMatcher(vpPlaneMatcher &&) noexcept = default;
vpPlaneMatcher &vpPlaneMatcher::operator=(vpPlaneMatcher &&) noexcept = default;

const vpPlaneMatch &vpPlaneMatcher::match(const vpImage<unsigned char> &image)
{
  m_impl->match(image);
  return m_impl->m_result;
}

const vpPlaneMatch &vpPlaneMatcher::result() const { return m_impl->m_result; }

vpHomography vpPlaneMatch::euclidean(const vpCameraParameters &camera) const
{
  vpHomography H;
  for (unsigned int i = 0; i < 9; ++i) {
    H[i / 3][i % 3] = homography[i];
  }
  return H.collineation2homography(camera);
}

std::vector<std::pair<double, double>> vpPlaneMatch::referencePoints(const vpCameraParameters &camera) const
{
  std::vector<std::pair<double, double>> points(inliers.size());
  std::transform(inliers.begin(), inliers.end(), points.begin(), [&camera](const auto &pair) {
    std::pair<double, double> p;
    vpPixelMeterConversion::convertPoint(camera, pair.first, p.first, p.second);
    return p;
  });
  return points;
}

END_VISP_NAMESPACE
