/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"
#include "vpOctomapCells.h"
#include "vpPlausible.h"

#include <visp3/avoidance/vpDepthOctomap.h>
#include <visp3/avoidance/vpSegmentDistance.h>
#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

struct vpDepthOctomap::Map {
  explicit Map(double resolution) : tree(resolution) {}
  octomap::OcTree tree;
};

namespace
{
constexpr vpFieldCheck fields("the depth octomap");

bool isBody(const Eigen::Vector3d &point, const vpPlacedCapsule *capsules, int count, double inflation)
{
  for (int i = 0; i < count; ++i) {
    if (vpSegmentDistance::point(capsules[i].from, capsules[i].to, point).distance <= capsules[i].radius + inflation) {
      return true;
    }
  }
  return false;
}
} // namespace

vpDepthOctomap::vpDepthOctomap(const vpDepthOctomapSpec &spec) : m_spec(spec)
{
  fields.positive("resolution", spec.resolution, "m");
  fields.notNegative("minRange", spec.minRange, "m");
  fields.require(spec.maxRange > spec.minRange && spec.maxRange <= vpLargestLength, "maxRange", spec.maxRange,
                 "> minRange and at most 10 km");
  fields.in("stride", spec.stride, {1});
  fields.notNegative("bodyInflation", spec.bodyInflation, "m");
  m_map = std::make_unique<Map>(spec.resolution);
}

vpDepthOctomap::~vpDepthOctomap() = default;
vpDepthOctomap::vpDepthOctomap(vpDepthOctomap &&other) noexcept = default;
vpDepthOctomap &vpDepthOctomap::operator=(vpDepthOctomap &&other) noexcept = default;

vpDepthReport vpDepthOctomap::insert(const vpImage<float> &depth, const vpCameraParameters &camera,
                                     const vpRigidTransform &fMc)
{
  return insert(depth, camera, fMc, nullptr, 0);
}

vpDepthReport vpDepthOctomap::insert(const vpImage<float> &depth, const vpCameraParameters &camera,
                                     const vpRigidTransform &fMc, const vpCollisionScene &scene,
                                     const vpCollisionData &placed)
{
  return insert(depth, camera, fMc, placed.capsules.data(), scene.capsuleCount());
}

vpDepthReport vpDepthOctomap::insert(const vpImage<float> &depth, const vpCameraParameters &camera,
                                     const vpRigidTransform &fMc, const vpPlacedCapsule *capsules, int count)
{
  vpDepthReport report;
  if (!vpIsPlace(fMc) || !(camera.get_px() != 0.) || !(camera.get_py() != 0.)) {
    return report;
  }
  octomap::Pointcloud cloud;
  const unsigned int stride = static_cast<unsigned int>(m_spec.stride);
  for (unsigned int v = 0; v < depth.getHeight(); v += stride) {
    for (unsigned int u = 0; u < depth.getWidth(); u += stride) {
      double x = 0., y = 0.;
      const double z = depth[v][u];
      vpPixelMeterConversion::convertPoint(camera, u, v, x, y);
      const Eigen::Vector3d ray = z * Eigen::Vector3d(x, y, 1.);
      const double range = ray.norm();
      if (!(z > 0.) || !std::isfinite(range) || range < m_spec.minRange) {
        ++report.invalid;
        continue;
      }
      // octomap computes in float: points beyond only give a direction.
      const Eigen::Vector3d point = fMc.R * ray * std::min(1., 2. * m_spec.maxRange / range) + fMc.p;
      if (range > m_spec.maxRange) {
        ++report.beyond;
        if (!m_spec.carve) {
          continue;
        }
      }
      else if (isBody(point, capsules, count, m_spec.bodyInflation)) {
        ++report.body;
        continue;
      }
      else {
        ++report.used;
      }
      cloud.push_back(static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z()));
    }
  }
  report.status = report.used > 0 ? vpDepthStatus::Ok : vpDepthStatus::NoPoint;
  octomap::OcTree &tree = m_map->tree;
  if (m_spec.carve) {
    const octomap::point3d viewpoint(static_cast<float>(fMc.p.x()), static_cast<float>(fMc.p.y()),
                                     static_cast<float>(fMc.p.z()));
    // Every ray separately: one ray per end cube would leave cubes on the way uncleared.
    tree.insertPointCloud(cloud, viewpoint, m_spec.maxRange, true, false);
  }
  else {
    for (const octomap::point3d &point : cloud) {
      tree.updateNode(point, true, true);
    }
  }
  tree.updateInnerOccupancy();
  return report;
}

void vpDepthOctomap::clear() { m_map->tree.clear(); }

vpOctree vpDepthOctomap::snapshot() const { return vpOctree(vpOctomapCells(m_map->tree, true), "depth images"); }

void vpDepthOctomap::save(const std::string &file) const
{
  // octomap's own conversion to binary decides every cell; the map itself is not changed.
  octomap::OcTree copy(m_map->tree);
  if (!copy.writeBinary(file)) {
    throw vpException(vpException::ioError, "%s: cannot be written", file.c_str());
  }
}

END_VISP_NAMESPACE
