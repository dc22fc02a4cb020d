/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTriangleSolid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

BEGIN_VISP_NAMESPACE

namespace
{
using Eigen::Vector3d;
constexpr double pi = 3.14159265358979323846;
constexpr int sides = 48;     // of the prism around a cylinder
constexpr double thin = 1e-5; // m: width of the triangle that stands for a point or a segment

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vector3d onCircle(double radius, int side, double z)
{
  const double angle = 2. * pi * side / sides;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}
} // namespace

void vpTriangleSolid::addBox(const Vector3d &centre, const Vector3d &half)
{
  const int first = static_cast<int>(vertices.size());
  for (int k = 0; k < 8; ++k) {
    const Vector3d sign(k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.);
    vertices.push_back(centre + half.cwiseProduct(sign));
  }
  constexpr int faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto &face : faces) {
    triangles.push_back({first + face[0], first + face[1], first + face[2]});
  }
}

// Around the cylinder: its sides touch it.
void vpTriangleSolid::addPrism(double inner, double half)
{
  vertices.emplace_back(0., 0., -half);
  vertices.emplace_back(0., 0., half);
  for (int k = 0; k < sides; ++k) {
    vertices.push_back(onCircle(inner / std::cos(pi / sides), k, -half));
    vertices.push_back(onCircle(inner / std::cos(pi / sides), k, half));
    const int low = 2 + 2 * k, high = low + 1, nextLow = 2 + 2 * ((k + 1) % sides), nextHigh = nextLow + 1;
    triangles.insert(triangles.end(),
                     {{low, nextLow, nextHigh}, {low, nextHigh, high}, {0, nextLow, low}, {1, high, nextHigh}});
  }
}

// A triangle that holds the segment and is hardly larger.
void vpTriangleSolid::addThread(const Vector3d &from, const Vector3d &to)
{
  const Vector3d axis = to - from;
  const Vector3d across = thin * axis.unitOrthogonal();
  vertices = {from, to, to + across};
  if (!(axis.norm() > thin)) {
    vertices = {from, from + thin * Vector3d::UnitX(), from + thin * Vector3d::UnitY()};
  }
  triangles = {{0, 1, 2}};
}

void vpTriangleSolid::finish()
{
  std::vector<int> root(vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int i) {
    while (root[at(i)] != i) {
      i = root[at(i)] = root[at(root[at(i)])];
    }
    return i;
  };
  for (const auto &t : triangles) {
    root[at(find(t[1]))] = find(t[0]);
    root[at(find(t[2]))] = find(t[0]);
  }
  box.setEmpty();
  parts.clear();
  std::vector<bool> used(vertices.size(), false);
  for (const auto &t : triangles) {
    for (const int i : t) {
      box.extend(vertices[at(i)]);
    }
    const std::size_t part = at(find(t[0]));
    if (!used[part]) {
      used[part] = true;
      parts.push_back(vertices[at(t[0])]);
    }
  }
}

void vpTriangleSolid::move(const vpRigidTransform &T)
{
  for (Vector3d &v : vertices) {
    v = T.R * v + T.p;
  }
  finish();
}

vpTriangleSolid vpTriangleSolid::of(const vpArmShape &shape)
{
  vpTriangleSolid solid;
  switch (shape.kind) {
  case vpArmShapeKind::Sphere:
    solid.addThread(Vector3d::Zero(), Vector3d::Zero());
    solid.radius = shape.size(0);
    break;
  case vpArmShapeKind::Cylinder:
    solid.addPrism(shape.size(0), 0.5 * shape.size(1));
    break;
  case vpArmShapeKind::Box:
    solid.addBox(Vector3d::Zero(), 0.5 * shape.size);
    break;
  case vpArmShapeKind::Mesh: {
    const vpTriangleMesh mesh = vpTriangleMesh::load(shape.file);
    solid.triangles = mesh.triangles();
    for (const Vector3d &v : mesh.vertices()) {
      solid.vertices.push_back(shape.size.cwiseProduct(v));
    }
    break;
  }
  }
  solid.move(shape.pose);
  return solid;
}

vpTriangleSolid vpTriangleSolid::of(const vpCollisionShape &shape)
{
  vpTriangleSolid solid;
  switch (shape.type()) {
  case vpShapeType::Sphere:
  case vpShapeType::Capsule:
    solid.addThread({0., 0., -0.5 * shape.length()}, {0., 0., 0.5 * shape.length()});
    break;
  case vpShapeType::Box:
    solid.addBox(Vector3d::Zero(), 0.5 * shape.size());
    break;
  case vpShapeType::Cylinder:
    solid.addPrism(shape.radius(), 0.5 * shape.length());
    break;
  case vpShapeType::Mesh:
    solid.vertices = shape.mesh().vertices();
    solid.triangles = shape.mesh().triangles();
    break;
  case vpShapeType::Octree:
    for (const vpOctreeCell &cell : shape.octree().cells()) {
      solid.addBox(cell.centre, Vector3d::Constant(0.5 * cell.size));
    }
    break;
  }
  solid.finish();
  return solid;
}

std::vector<Vector3d> vpTriangleSolid::pointsOn(const vpArmShape &shape, const vpTriangleSolid &solid)
{
  if (shape.kind != vpArmShapeKind::Cylinder) {
    return solid.vertices;
  }
  std::vector<Vector3d> points;
  for (int k = 0; k < sides; ++k) {
    for (const double sense : {-0.5, 0.5}) {
      points.push_back(shape.pose.R * onCircle(shape.size(0), k, sense * shape.size(1)) + shape.pose.p);
    }
  }
  return points;
}

bool vpTriangleSolid::contains(const Vector3d &p) const noexcept
{
  if (!box.contains(p)) {
    return false;
  }
  // Solid angles of the triangles (van Oosterom and Strackee); 4 pi is one turn.
  double sum = 0.;
  for (const auto &t : triangles) {
    const Vector3d a = vertices[at(t[0])] - p, b = vertices[at(t[1])] - p, c = vertices[at(t[2])] - p;
    const double x = a.norm(), y = b.norm(), z = c.norm();
    sum += 2. * std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
  }
  return std::fabs(sum) > 2. * pi;
}

END_VISP_NAMESPACE
