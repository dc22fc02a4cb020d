/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpDepthObstacles.h>

#include "vpCollisionCore.h"
#include "vpFieldCheck.h"
#include "vpPlausible.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the depth obstacles");

bool isNear(const vpCollisionCore &core, const Eigen::Vector3d &point, double margin)
{
  const double reach = core.radius + margin;
  const double bound = reach + core.bound;
  return (point - core.centre).squaredNorm() <= bound * bound &&
         core.nearest(point, point, reach + 1e-9).distance <= reach;
}

bool isKnown(const vpCollisionScene &scene, int except, const Eigen::Vector3d &point, double margin)
{
  if (scene.ground() && scene.ground()->normal.dot(point) - scene.ground()->offset <= margin) {
    return true;
  }
  for (int i = 0; i < scene.objectCount(); ++i) {
    if (i != except && isNear(scene.core(i), point, margin)) {
      return true;
    }
  }
  return false;
}

bool isSame(const std::vector<vpOctreeCell> &a, const std::vector<vpOctreeCell> &b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const vpOctreeCell &x, const vpOctreeCell &y) {
    return x.size == y.size && x.centre == y.centre;
  });
}
} // namespace

const char *vpDepthReport::message() const noexcept
{
  switch (status) {
  case vpDepthStatus::Ok:
    return "the depth image was used";
  case vpDepthStatus::NoPoint:
    return "the depth image has no depth in range that is not the arm";
  default:
    return "the camera's pose is no rotation and place in range, or its focal lengths are 0";
  }
}

vpDepthOctomapSpec vpDepthObstaclesSpec::defaultMap() noexcept
{
  vpDepthOctomapSpec spec;
  spec.stride = 4;
  return spec;
}

void vpDepthObstaclesSpec::validate() const
{
  if (name.empty()) {
    throw vpException(vpException::badValue, "name of the depth obstacles is empty");
  }
  fields.notNegative("inflation", inflation, "m");
  fields.notNegative("knownMargin", knownMargin, "m");
}

vpDepthObstacles::vpDepthObstacles(const vpDepthObstaclesSpec &spec) : m_spec(spec), m_map(spec.map)
{
  m_spec.validate();
}

vpDepthReport vpDepthObstacles::insert(const vpImage<float> &depth, const vpCameraParameters &camera,
                                       const vpRigidTransform &fMc, const vpCollisionScene &scene,
                                       const vpCollisionData &placed)
{
  if (!vpIsPlace(fMc) || !(camera.get_px() != 0.) || !(camera.get_py() != 0.)) {
    return {};
  }
  m_unknown = depth;
  const int own = scene.find(m_spec.name);
  const unsigned int stride = static_cast<unsigned int>(m_spec.map.stride);
  int known = 0;
  for (unsigned int v = 0; v < depth.getHeight(); v += stride) {
    for (unsigned int u = 0; u < depth.getWidth(); u += stride) {
      const double z = depth[v][u];
      if (!(z > 0.) || !std::isfinite(z)) {
        continue;
      }
      double x = 0., y = 0.;
      vpPixelMeterConversion::convertPoint(camera, u, v, x, y);
      const Eigen::Vector3d ray = z * Eigen::Vector3d(x, y, 1.);
      const double range = ray.norm();
      if (range >= m_spec.map.minRange && range <= m_spec.map.maxRange &&
          isKnown(scene, own, fMc.R * ray + fMc.p, m_spec.knownMargin)) {
        m_unknown[v][u] = 0.F;
        ++known;
      }
    }
  }
  vpDepthReport report = m_map.insert(m_unknown, camera, fMc, scene, placed);
  report.known = known;
  report.invalid -= known;
  if (report.status == vpDepthStatus::NoPoint && known > 0) {
    report.status = vpDepthStatus::Ok;
  }
  m_isNew = true;
  return report;
}

void vpDepthObstacles::clear()
{
  m_map.clear();
  m_isNew = true;
}

bool vpDepthObstacles::applyTo(vpCollisionScene &scene)
{
  const int i = scene.find(m_spec.name);
  if (i >= 0 && m_applied.empty()) {
    throw vpException(vpException::badValue, "the scene has an object %s that does not come from depth images",
                      m_spec.name.c_str());
  }
  if (!m_isNew) {
    return false;
  }
  m_isNew = false;
  const vpOctree now = m_map.snapshot();
  if (isSame(now.cells(), m_applied)) {
    return false;
  }
  if (i >= 0) {
    scene.remove(i);
  }
  m_applied = now.cells();
  if (!m_applied.empty()) {
    vpCollisionObject object;
    object.name = m_spec.name;
    object.shape = vpCollisionShape::octree(now);
    object.inflation = m_spec.inflation;
    scene.add(object);
  }
  return true;
}

END_VISP_NAMESPACE
