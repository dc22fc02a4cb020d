/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlanarTargetImpl.h"

#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

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

END_VISP_NAMESPACE
