/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/planar_target/vpPlaneTracker.h>

#include "vpKeypoints.h"

#include <visp3/core/vpException.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

BEGIN_VISP_NAMESPACE

namespace
{
const cv::Size window(15, 15);          // px of the reference
constexpr int levels = 3;               // of the pyramid: a shift of about 50 px
constexpr int passes = 3;               // warps
constexpr double nearly = 0.3;          // px; shift after which another warp changes nothing
constexpr double lowestQuality = 0.01;  // of a corner against the best one
constexpr double inlierThreshold = 1.5; // px
constexpr int margin = 2;               // px at the frame's border

cv::Matx33d matrixOf(const std::array<double, 9> &H) { return cv::Matx33d(H.data()); }
} // namespace

class vpPlaneTracker::Impl
{
public:
  Impl(const vpImage<unsigned char> &reference, unsigned int points, const vpPlanarTargetSpec &spec)
    : m_matcher(reference, spec), m_minimum(static_cast<int>(spec.minInliers))
  {
    if (!(points >= 20 && points <= 2000)) {
      throw vpException(vpException::badValue, "the plane tracker has %u points, must have 20..2000", points);
    }
    const cv::Mat image = pixelsOf(reference);
    const double apart = 0.5 * std::sqrt(static_cast<double>(image.total()) / points);
    cv::goodFeaturesToTrack(image, m_corners, static_cast<int>(points), lowestQuality, apart);
    if (static_cast<int>(m_corners.size()) < m_minimum) {
      throw vpException(vpException::badValue,
                        "reference image has too little texture: %zu corners, at least %d are needed", m_corners.size(),
                        m_minimum);
    }
    cv::cornerSubPix(image, m_corners, cv::Size(3, 3), cv::Size(-1, -1),
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01});
    for (const cv::Point2f &p : m_corners) {
      m_reference.emplace_back(p.y, p.x);
    }
    makeFallback(reference, spec);
    m_image = image.clone();
    cv::buildOpticalFlowPyramid(m_image, m_pyramid, window, levels);
  }

  void acquire(const vpImage<unsigned char> &image)
  {
    const vpPlaneMatch *match = &m_matcher.match(image);
    if (!match->hasHomography() && m_fallback) {
      match = &m_fallback->match(image);
    }
    if (!match->hasHomography()) {
      m_result = vpPlaneTrack();
      m_result.message = match->message;
      return;
    }
    track(image, match->homography);
  }

  void track(const vpImage<unsigned char> &image, const std::array<double, 9> &guess)
  {
    m_result = vpPlaneTrack();
    const cv::Mat frame = pixelsOf(image);
    cv::Matx33d H = matrixOf(guess);
    double shift = 2. * nearly;
    for (int k = 0; k < passes && shift > nearly; ++k) {
      if (!follow(frame, H, shift)) {
        m_result.message = "The plane is not near the expected place.";
        return;
      }
    }
    conclude(H);
  }

  std::vector<vpImagePoint> m_reference;
  vpPlaneTrack m_result;

private:
  // AKAZE, see vpPlanarTargetSpec::fallback, where it finds enough in the reference.
  void makeFallback(const vpImage<unsigned char> &reference, vpPlanarTargetSpec spec)
  {
    if (!spec.fallback || spec.keypoints == vpKeypointType::AKAZE) {
      return;
    }
    spec.keypoints = vpKeypointType::AKAZE;
    try {
      m_fallback.emplace(reference, spec);
    }
    catch (const vpException &) {
    }
  }
  bool follow(const cv::Mat &frame, cv::Matx33d &H, double &shift);
  void warp(const cv::Mat &frame, const cv::Matx33d &H);
  void matchLight();
  void conclude(const cv::Matx33d &H);

  vpPlaneMatcher m_matcher;
  std::optional<vpPlaneMatcher> m_fallback;
  int m_minimum;
  cv::Mat m_image; // of the reference
  std::vector<cv::Mat> m_pyramid;
  std::vector<cv::Point2f> m_corners; // of the reference
  cv::Mat m_smooth, m_warped, m_shown;
  std::vector<cv::Point2f> m_found, m_from, m_to;
  std::vector<int> m_index; // of m_from in m_corners
  std::vector<unsigned char> m_agrees;
};

// The frame as the reference camera would have seen it. A frame that is nearer is smoothed first, else the warp would
// alias.
void vpPlaneTracker::Impl::warp(const cv::Mat &frame, const cv::Matx33d &H)
{
  const double area = std::abs(cv::determinant(H)) /
                      std::pow(std::abs(H(2, 0) * 0.5 * m_image.cols + H(2, 1) * 0.5 * m_image.rows + H(2, 2)), 3);
  const double scale = std::sqrt(area);
  const bool near = scale > 1.3;
  if (near) {
    cv::GaussianBlur(frame, m_smooth, cv::Size(), 0.5 * std::sqrt(scale * scale - 1.));
  }
  const int flags = cv::INTER_LINEAR | cv::WARP_INVERSE_MAP;
  cv::warpPerspective(near ? m_smooth : frame, m_warped, H, m_image.size(), flags);
  cv::warpPerspective(cv::Mat(frame.size(), CV_8UC1, cv::Scalar(255)), m_shown, H, m_image.size(),
                      cv::INTER_NEAREST | cv::WARP_INVERSE_MAP);
}

// Gain and bias of the frame as those of the reference, where it shows the reference.
void vpPlaneTracker::Impl::matchLight()
{
  cv::Scalar mean, deviation, wantedMean, wantedDeviation;
  cv::meanStdDev(m_warped, mean, deviation, m_shown);
  cv::meanStdDev(m_image, wantedMean, wantedDeviation, m_shown);
  if (deviation[0] > 1.) {
    const double gain = wantedDeviation[0] / deviation[0];
    m_warped.convertTo(m_warped, CV_8U, gain, wantedMean[0] - gain * mean[0]);
  }
}

// One warp: corners in the warped frame, and the homography that they agree on. shift: their mean distance from the
// guess, px.
bool vpPlaneTracker::Impl::follow(const cv::Mat &frame, cv::Matx33d &H, double &shift)
{
  warp(frame, H);
  matchLight();
  m_found = m_corners;
  std::vector<unsigned char> status;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(m_pyramid, m_warped, m_corners, m_found, status, error, window, levels,
                           {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.005}, cv::OPTFLOW_USE_INITIAL_FLOW,
                           1e-4);
  std::vector<cv::Point2f> inFrame;
  cv::perspectiveTransform(m_found, inFrame, H);
  const cv::Rect2f inside(margin, margin, static_cast<float>(frame.cols - 2 * margin),
                          static_cast<float>(frame.rows - 2 * margin));
  m_from.clear();
  m_to.clear();
  m_index.clear();
  for (std::size_t i = 0; i < m_corners.size(); ++i) {
    if (status[i] && inside.contains(inFrame[i])) {
      m_from.push_back(m_corners[i]);
      m_to.push_back(inFrame[i]);
      m_index.push_back(static_cast<int>(i));
    }
  }
  if (static_cast<int>(m_from.size()) < m_minimum) {
    return false;
  }
  const cv::Mat fitted = cv::findHomography(m_from, m_to, cv::USAC_MAGSAC, inlierThreshold, m_agrees, 2000, 0.999);
  if (fitted.empty() || cv::countNonZero(m_agrees) < m_minimum) {
    return false;
  }
  shift = 0.;
  for (std::size_t k = 0; k < m_from.size(); ++k) {
    const int i = m_index[k];
    shift += m_agrees[k] ? cv::norm(m_found[static_cast<std::size_t>(i)] - m_from[k]) / cv::countNonZero(m_agrees) : 0.;
  }
  H = cv::Matx33d(fitted.ptr<double>());
  return true;
}

void vpPlaneTracker::Impl::conclude(const cv::Matx33d &H)
{
  vpPlaneTrack &r = m_result;
  std::copy(H.val, H.val + 9, r.homography.begin());
  std::vector<cv::Point2f> expected;
  cv::perspectiveTransform(m_corners, expected, H);
  for (const cv::Point2f &p : expected) {
    r.points.emplace_back(p.y, p.x);
  }
  r.visible.assign(m_corners.size(), 0);
  double squares = 0.;
  for (std::size_t k = 0; k < m_from.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(m_index[k]);
    if (m_agrees[k]) {
      r.visible[i] = 1;
      ++r.count;
      squares += (m_to[k] - expected[i]).dot(m_to[k] - expected[i]);
      r.points[i] = vpImagePoint(m_to[k].y, m_to[k].x);
    }
  }
  r.found = true;
  r.sigma = std::sqrt(squares / std::max(2. * r.count - 8., 1.));
  char text[120];
  std::snprintf(text, sizeof(text), "%u of %zu corners agree on one plane within %.2f px.", r.count, m_corners.size(),
                r.sigma);
  r.message = text;
}

vpPlaneTracker::vpPlaneTracker(const vpImage<unsigned char> &reference, unsigned int points,
                               const vpPlanarTargetSpec &spec)
  : m_impl(std::make_unique<Impl>(reference, points, spec))
{}

vpPlaneTracker::~vpPlaneTracker() = default;
vpPlaneTracker::vpPlaneTracker(vpPlaneTracker &&) noexcept = default;
vpPlaneTracker &vpPlaneTracker::operator=(vpPlaneTracker &&) noexcept = default;

const vpPlaneTrack &vpPlaneTracker::acquire(const vpImage<unsigned char> &image)
{
  m_impl->acquire(image);
  return m_impl->m_result;
}

const vpPlaneTrack &vpPlaneTracker::track(const vpImage<unsigned char> &image, const std::array<double, 9> &guess)
{
  m_impl->track(image, guess);
  return m_impl->m_result;
}

const std::vector<vpImagePoint> &vpPlaneTracker::reference() const { return m_impl->m_reference; }

const vpPlaneTrack &vpPlaneTracker::result() const { return m_impl->m_result; }

END_VISP_NAMESPACE
