/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCollisionCore.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

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

vpClearance vpRounded(const vpNearestPoints &cores, double radius, double otherRadius,
                      const Eigen::Vector3d &otherCentre) noexcept
{
  vpClearance clearance;
  clearance.distance = cores.distance - radius - otherRadius;
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

END_VISP_NAMESPACE
