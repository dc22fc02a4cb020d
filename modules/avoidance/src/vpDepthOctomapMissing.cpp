/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMissingLibrary.h"

#include <visp3/avoidance/vpDepthOctomap.h>

BEGIN_VISP_NAMESPACE

struct vpDepthOctomap::Map {
};

vpDepthOctomap::vpDepthOctomap(const vpDepthOctomapSpec &) { vpMissingLibrary("vpDepthOctomap", "octomap"); }
vpDepthOctomap::~vpDepthOctomap() = default;
vpDepthOctomap::vpDepthOctomap(vpDepthOctomap &&other) noexcept = default;
vpDepthOctomap &vpDepthOctomap::operator=(vpDepthOctomap &&other) noexcept = default;
vpDepthReport vpDepthOctomap::insert(const vpImage<float> &, const vpCameraParameters &, const vpRigidTransform &)
{
  return {};
}
vpDepthReport vpDepthOctomap::insert(const vpImage<float> &, const vpCameraParameters &, const vpRigidTransform &,
                                     const vpCollisionScene &, const vpCollisionData &)
{
  return {};
}
void vpDepthOctomap::clear() {}
vpOctree vpDepthOctomap::snapshot() const { return vpOctree({}, "depth images"); }
void vpDepthOctomap::save(const std::string &) const {}

END_VISP_NAMESPACE
