/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCollisionObject.h>

#include "vpCollisionCore.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
double checked(const char *what, double value, bool zeroAllowed = false)
{
  if (!(value <= vpLargestLength) || !(zeroAllowed ? value >= 0. : value > 0.)) {
    throw vpException(vpException::badValue, "%s is %g m, must be %s 0 and at most %g m", what, value,
                      zeroAllowed ? ">=" : ">", vpLargestLength);
  }
  return value;
}

// Clearance of two rounded cores from the nearest points of the cores; the distance may be negative. Beyond the cutoff
// without points.
vpClearance rounded(const vpNearestPoints &cores, double radius, double otherRadius, const Eigen::Vector3d &otherCentre,
                    double cutoff) noexcept
{
  vpClearance clearance;
  clearance.distance = cores.distance - radius - otherRadius;
  if (clearance.distance > cutoff) {
    return clearance;
  }
  Eigen::Vector3d away = cores.onSegment - cores.onOther;
  if (cores.distance < 0.) {
    away = -away;
  }
  if (!(away.squaredNorm() > 1e-24)) {
    away = cores.onSegment - otherCentre;
  }
  const double length = away.norm();
  clearance.normal =
      length > 1e-12 && std::isfinite(length) ? Eigen::Vector3d(away / length) : Eigen::Vector3d::UnitZ();
  clearance.onArm = cores.onSegment - radius * clearance.normal;
  clearance.onOther = cores.onOther + otherRadius * clearance.normal;
  return clearance;
}
} // namespace

vpCollisionShape vpCollisionShape::sphere(double radius)
{
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Sphere;
  shape.m_radius = checked("radius of the sphere", radius);
  return shape;
}

vpCollisionShape vpCollisionShape::capsule(double radius, double length)
{
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Capsule;
  shape.m_radius = checked("radius of the capsule", radius);
  shape.m_length = checked("length of the capsule", length, true);
  return shape;
}

vpCollisionShape vpCollisionShape::box(const Eigen::Vector3d &size)
{
  static const char *const names[] = {"size of the box along x", "size of the box along y", "size of the box along z"};
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Box;
  for (int i = 0; i < 3; ++i) {
    shape.m_size(i) = checked(names[i], size(i));
  }
  return shape;
}

vpCollisionShape vpCollisionShape::cylinder(double radius, double length)
{
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Cylinder;
  shape.m_radius = checked("radius of the cylinder", radius);
  shape.m_length = checked("length of the cylinder", length);
  return shape;
}

vpCollisionShape vpCollisionShape::mesh(const vpTriangleMesh &mesh, vpMeshUse use)
{
  if (use == vpMeshUse::Solid && !mesh.isWatertight()) {
    throw vpException(
        vpException::badValue,
        "%s; close it, or say that a surface is enough (\"surface\": true in a scene, vpMeshUse::Surface)",
        mesh.message().c_str());
  }
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Mesh;
  shape.m_mesh = mesh;
  return shape;
}

vpCollisionShape vpCollisionShape::octree(const vpOctree &octree)
{
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Octree;
  shape.m_octree = octree;
  return shape;
}

vpRigidTransform vpCollisionObject::poseAt(double t) const noexcept
{
  if (t == 0.) {
    return pose;
  }
  const Eigen::Vector3d v(velocity[0], velocity[1], velocity[2]), w(velocity[3], velocity[4], velocity[5]);
  return {vpSO3::exp(t * w) * pose.R, pose.p + t * v};
}

vpCollisionCore::vpCollisionCore(const vpCollisionObject &object) : type(object.shape.type()), radius(object.inflation)
{
  const vpCollisionShape &shape = object.shape;
  switch (type) {
  case vpShapeType::Sphere:
  case vpShapeType::Capsule:
    radius += shape.radius();
    half.z() = 0.5 * shape.length();
    bound = half.z();
    break;
  case vpShapeType::Box:
    half = 0.5 * shape.size();
    bound = half.norm();
    break;
  case vpShapeType::Cylinder:
    half << shape.radius(), 0., 0.5 * shape.length();
    bound = half.norm();
    break;
  case vpShapeType::Mesh:
    mesh = &shape.mesh().data();
    middle = mesh->tree.centre();
    bound = mesh->tree.radius();
    break;
  case vpShapeType::Octree:
    octree = &shape.octree().data();
    middle = octree->tree.centre();
    bound = octree->tree.radius();
    break;
  }
  move(object.pose);
}

vpNearestPoints vpCollisionCore::nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                         double cutoff) const noexcept
{
  if (type == vpShapeType::Sphere) {
    return vpSegmentNearest::point(from, to, pose.p);
  }
  if (type == vpShapeType::Capsule) {
    return vpSegmentNearest::segment(from, to, end(-1.), end(1.));
  }
  const Eigen::Vector3d a = pose.R.transpose() * (from - pose.p), b = pose.R.transpose() * (to - pose.p);
  vpNearestPoints near;
  switch (type) {
  case vpShapeType::Box:
    near = vpSegmentNearest::box(a, b, half);
    break;
  case vpShapeType::Cylinder:
    near = vpSegmentNearest::cylinder(a, b, half.x(), half.z());
    break;
  case vpShapeType::Mesh:
    near = mesh->nearest(a, b, cutoff);
    break;
  default:
    near = octree->nearest(a, b, cutoff);
    break;
  }
  near.onSegment = pose.R * near.onSegment + pose.p;
  near.onOther = pose.R * near.onOther + pose.p;
  return near;
}

vpClearance vpSelfClearance(const vpPlacedCapsule &a, const vpPlacedCapsule &b, double cutoff) noexcept
{
  vpClearance clearance =
      rounded(vpSegmentNearest::segment(a.from, a.to, b.from, b.to), a.radius, b.radius, b.centre, cutoff);
  clearance.kind = vpCollisionKind::Self;
  return clearance;
}

vpClearance vpGroundClearance(const vpHalfSpace &ground, const vpPlacedCapsule &c) noexcept
{
  const double from = ground.normal.dot(c.from) - ground.offset, to = ground.normal.dot(c.to) - ground.offset;
  const double height = std::min(from, to);
  vpClearance clearance;
  clearance.distance = height - c.radius;
  clearance.kind = vpCollisionKind::Ground;
  clearance.normal = ground.normal;
  clearance.onArm = (from <= to ? c.from : c.to) - c.radius * ground.normal;
  clearance.onOther = clearance.onArm - clearance.distance * ground.normal;
  return clearance;
}

vpClearance vpCollisionCore::clearance(const vpPlacedCapsule &c, double cutoff) const noexcept
{
  const double radii = c.radius + radius;
  vpClearance result = rounded(nearest(c.from, c.to, cutoff + radii), c.radius, radius, centre, cutoff);
  result.kind = vpCollisionKind::Object;
  return result;
}

END_VISP_NAMESPACE
