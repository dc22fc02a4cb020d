/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpDetour.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Eigen::Vector3d;

constexpr double neighbourhood = 0.2; // m: an octree may be the whole room; only the part near the position is used

//! Extent of the surface along a unit vector; vector and position in the shape's frame.
double extent(const vpCollisionShape &shape, const Vector3d &u, const Vector3d &place)
{
  const double across = std::hypot(u.x(), u.y()), along = std::fabs(u.z());
  switch (shape.type()) {
  case vpShapeType::Sphere:
    return shape.radius();
  case vpShapeType::Capsule:
    return shape.radius() + 0.5 * shape.length() * along;
  case vpShapeType::Box:
    return 0.5 * shape.size().dot(u.cwiseAbs());
  case vpShapeType::Cylinder:
    return shape.radius() * across + 0.5 * shape.length() * along;
  case vpShapeType::Mesh: {
    double most = -1e9;
    for (const Vector3d &p : shape.mesh().vertices()) {
      most = std::max(most, u.dot(p));
    }
    return most;
  }
  case vpShapeType::Octree:
    break;
  }
  double most = -1e9;
  for (const vpOctreeCell &cell : shape.octree().cells()) {
    if ((cell.centre - place).norm() < neighbourhood) {
      most = std::max(most, u.dot(cell.centre) + 0.5 * cell.size * u.cwiseAbs().sum());
    }
  }
  return most;
}

//! Two unit vectors perpendicular to a direction; the first one is horizontal.
void across(const Vector3d &d, Vector3d &level, Vector3d &up)
{
  level = Vector3d::UnitZ().cross(d);
  level = level.norm() > 1e-3 ? level.normalized() : Vector3d::UnitX();
  up = d.cross(level).normalized();
}
} // namespace

double extentAlong(const vpCollisionObject &object, const Vector3d &direction, const Vector3d &place)
{
  const Eigen::Matrix3d R = object.pose.R.transpose();
  return extent(object.shape, R * direction, R * (place - object.pose.p)) + object.inflation;
}

std::vector<Vector3d> placesBeside(const vpCollisionScene &scene, const vpForecast &conflict, const Vector3d &from,
                                   const Vector3d &to, double clearance, int sides)
{
  std::vector<Vector3d> places;
  const vpClearance &pair = conflict.pair;
  const Vector3d way = to - from;
  Vector3d level, up;
  across(way.norm() > 1e-6 ? Vector3d(way.normalized()) : Vector3d::UnitX(), level, up);
  if (pair.kind == vpCollisionKind::None) { // the arm itself cannot follow there
    for (int k = 0; k < sides; ++k) {
      const double angle = 2. * M_PI * k / sides;
      places.push_back(conflict.tool + 0.15 * (std::cos(angle) * level + std::sin(angle) * up));
    }
    return places;
  }
  // Away from the obstacle, wherever on the arm the contact is.
  for (const double shift : {0.1, 0.2}) {
    places.push_back(conflict.tool + shift * pair.normal);
  }
  if (pair.kind != vpCollisionKind::Object) {
    return places;
  }
  vpCollisionObject object = scene.object(pair.other);
  object.pose = object.poseAt(conflict.time);
  const double share =
      way.squaredNorm() > 0. ? std::clamp((object.pose.p - from).dot(way) / way.squaredNorm(), 0.05, 0.95) : 0.5;
  const Vector3d foot = from + share * way;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2. * M_PI * k / sides;
    const Vector3d u = std::cos(angle) * level + std::sin(angle) * up;
    const double out = (object.pose.p - foot).dot(u) + extentAlong(object, u, pair.onOther) + clearance;
    for (const double more : {0., 0.08}) {
      places.push_back(foot + std::max(0.03, out + more) * u);
    }
  }
  return places;
}

END_VISP_NAMESPACE
