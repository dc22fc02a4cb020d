/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"

#include "vpPlanarTargetImpl.h"

#include <visp3/core/vpException.h>

#include <array>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::array<std::pair<vpKeypointType, const char *>, 6> keypointNames = {{{vpKeypointType::ORB, "ORB"},
                                                                                   {vpKeypointType::SIFT, "SIFT"},
                                                                                   {vpKeypointType::AKAZE, "AKAZE"},
                                                                                   {vpKeypointType::KAZE, "KAZE"},
                                                                                   {vpKeypointType::BRISK, "BRISK"},
                                                                                   {vpKeypointType::SURF, "SURF"}}};
} // namespace

vpPlanarTarget::vpPlanarTarget(const vpImage<unsigned char> &reference, double width, double height,
                               const vpCameraParameters &camera, const vpPlanarTargetSpec &spec)
  : m_impl(std::make_unique<Impl>(reference, width, height, camera, spec))
{}

vpPlanarTarget::~vpPlanarTarget() = default;
vpPlanarTarget::vpPlanarTarget(vpPlanarTarget &&) noexcept = default;
vpPlanarTarget &vpPlanarTarget::operator=(vpPlanarTarget &&) noexcept = default;

const vpPlanarTargetResult &vpPlanarTarget::process(const vpImage<unsigned char> &image)
{
  if (!m_impl->refuse(image)) {
    m_impl->m_ownFrame.assign(image);
    m_impl->process(m_impl->m_ownFrame);
  }
  return m_impl->m_result;
}

const vpPlanarTargetResult &vpPlanarTarget::acquire(const vpImage<unsigned char> &image)
{
  if (!m_impl->refuse(image)) {
    m_impl->m_ownFrame.assign(image);
    m_impl->acquire(m_impl->m_ownFrame);
  }
  return m_impl->m_result;
}

const vpPlanarTargetResult &vpPlanarTarget::track(const vpImage<unsigned char> &image)
{
  if (!m_impl->refuse(image)) {
    m_impl->m_ownFrame.assign(image);
    m_impl->trackLast(m_impl->m_ownFrame);
  }
  return m_impl->m_result;
}

const vpPlanarTargetResult &vpPlanarTarget::track(const vpImage<unsigned char> &image,
                                                  const vpHomogeneousMatrix &cMoGuess)
{
  if (!m_impl->refuse(image)) {
    m_impl->m_ownFrame.assign(image);
    m_impl->track(m_impl->m_ownFrame, vpRigidPose::fromMatrix(cMoGuess));
  }
  return m_impl->m_result;
}

void vpPlanarTarget::reset()
{
  m_impl->reset();
  m_impl->m_fresh = true;
}

const vpPlanarTargetResult &vpPlanarTarget::result() const { return m_impl->m_result; }
double vpPlanarTarget::width() const { return m_impl->m_plane.width; }
double vpPlanarTarget::height() const { return m_impl->m_plane.height; }

const char *vpToString(vpKeypointType type)
{
  for (const auto &entry : keypointNames) {
    if (entry.first == type) {
      return entry.second;
    }
  }
  return "unknown";
}

vpKeypointType vpKeypointTypeFromString(const std::string &name)
{
  std::string known;
  for (const auto &entry : keypointNames) {
    if (name == entry.second) {
      return entry.first;
    }
    known += std::string(known.empty() ? "" : ", ") + entry.second;
  }
  throw vpException(vpException::badValue, "keypoint detector '%s' is not known, choose one of %s", name.c_str(),
                    known.c_str());
}

const char *vpToString(vpPlanarTargetStatus status)
{
  switch (status) {
  case vpPlanarTargetStatus::Acquired:
    return "Acquired";
  case vpPlanarTargetStatus::Tracked:
    return "Tracked";
  case vpPlanarTargetStatus::Ambiguous:
    return "Ambiguous";
  case vpPlanarTargetStatus::Extrapolated:
    return "Extrapolated";
  case vpPlanarTargetStatus::NoTexture:
    return "NoTexture";
  case vpPlanarTargetStatus::TooFewInliers:
    return "TooFewInliers";
  case vpPlanarTargetStatus::OutOfView:
    return "OutOfView";
  case vpPlanarTargetStatus::LowCorrelation:
    return "LowCorrelation";
  case vpPlanarTargetStatus::NoFrame:
    return "NoFrame";
  }
  return "unknown";
}

void vpPlanarTargetSpec::validate() const
{
  if (vpToString(keypoints) == std::string("unknown")) {
    throw vpException(vpException::badValue, "keypoint type %d is not known", static_cast<int>(keypoints));
  }
  constexpr vpFieldCheck fields("the planar target");
  fields.in("minInliers", minInliers, {8.});
  fields.in("maxKeypoints", maxKeypoints, {1. * minInliers, 100000.});
  fields.notNegative("surfThreshold", surfThreshold);
  fields.in("surfOctaves", surfOctaves, {1., 8.});
  fields.in("surfLayers", surfLayers, {1., 16.});
  fields.in("inlierThreshold", inlierThreshold, vpFieldRange::positive(1e3), "px");
  fields.in("minCorrelation", minCorrelation, {0., 1.});
  fields.in("refinementSize", refinementSize, {32., 4096.}, "px");
  fields.in("maxIterations", maxIterations, {1., 1000.});
}

END_VISP_NAMESPACE
