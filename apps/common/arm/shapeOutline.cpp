/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "shapeOutline.h"

#include <algorithm>
#include <cmath>

namespace vpApp
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr int CORNERS = 40; // of a circle

double cross(const Vector2d &o, const Vector2d &a, const Vector2d &b)
{
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

//! Points whose hull, thickened by a radius, is the shape.
std::vector<Vector3d> core(const vpCollisionShape &shape)
{
  std::vector<Vector3d> points;
  const Vector3d half = 0.5 * shape.size();
  switch (shape.type()) {
  case vpShapeType::Sphere:
    return {Vector3d::Zero()};
  case vpShapeType::Capsule:
    return {{0., 0., 0.5 * shape.length()}, {0., 0., -0.5 * shape.length()}};
  case vpShapeType::Box:
    for (int i = 0; i < 8; ++i) {
      points.emplace_back((i & 1 ? 1. : -1.) * half.x(), (i & 2 ? 1. : -1.) * half.y(), (i & 4 ? 1. : -1.) * half.z());
    }
    return points;
  default: // a cylinder
    for (int i = 0; i < 2 * CORNERS; ++i) {
      const double angle = 2. * M_PI * i / CORNERS;
      points.emplace_back(shape.radius() * std::cos(angle), shape.radius() * std::sin(angle),
                          (i < CORNERS ? 0.5 : -0.5) * shape.length());
    }
    return points;
  }
}

double thickness(const vpCollisionObject &object)
{
  const vpShapeType type = object.shape.type();
  const bool round = type == vpShapeType::Sphere || type == vpShapeType::Capsule;
  return (round ? object.shape.radius() : 0.) + object.inflation;
}
} // namespace

Vector2d project(const Vector3d &place, ArmView view)
{
  return view == ArmView::Top ? Vector2d(place.x(), place.y()) : Vector2d(place.y(), place.z());
}

Polygon convexHull(std::vector<Vector2d> points)
{
  std::sort(points.begin(), points.end(),
            [](const Vector2d &a, const Vector2d &b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  Polygon hull;
  for (int pass = 0; pass < 2; ++pass) { // below, then above
    const std::size_t begin = hull.size();
    for (const Vector2d &p : points) {
      while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back(); // equals the first of the other pass
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<Polygon> outline(const vpCollisionObject &object, ArmView view)
{
  const auto place = [&](const Vector3d &p) { return project(object.pose.R * p + object.pose.p, view); };
  std::vector<Polygon> polygons;
  if (object.shape.type() == vpShapeType::Mesh) {
    for (const auto &triangle : object.shape.mesh().triangles()) {
      Polygon polygon;
      for (const int corner : triangle) {
        polygon.push_back(place(object.shape.mesh().vertices()[static_cast<std::size_t>(corner)]));
      }
      polygons.push_back(polygon);
    }
    return polygons;
  }
  if (object.shape.type() == vpShapeType::Octree) {
    for (const vpOctreeCell &cell : object.shape.octree().cells()) {
      std::vector<Vector2d> corners;
      for (const Vector3d &corner : core(vpCollisionShape::box(Vector3d::Constant(cell.size)))) {
        corners.push_back(place(cell.centre + corner));
      }
      polygons.push_back(convexHull(corners));
    }
    return polygons;
  }
  std::vector<Vector2d> points;
  const double r = thickness(object);
  for (const Vector3d &p : core(object.shape)) {
    for (int i = 0; i < (r > 0. ? CORNERS : 1); ++i) {
      const double angle = 2. * M_PI * i / CORNERS;
      points.push_back(place(p) + r * Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  return {convexHull(points)};
}
} // namespace vpApp
