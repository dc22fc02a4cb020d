/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpBodyMesh.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Vertices = std::vector<Eigen::Vector3d>;
using Triangles = std::vector<std::array<int, 3>>;

void addBox(const Eigen::Vector3d &size, Vertices &vertices, Triangles &triangles)
{
  for (int i = 0; i < 8; ++i) {
    vertices.emplace_back(0.5 * size.cwiseProduct(Eigen::Vector3d((i & 1) != 0 ? 1. : -1., (i & 2) != 0 ? 1. : -1.,
                                                                  (i & 4) != 0 ? 1. : -1.)));
  }
  triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
               {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
}

// The prism of 48 sides about a cylinder.
void addCylinder(double radius, double length, Vertices &vertices, Triangles &triangles)
{
  constexpr int sides = 48;
  const double outer = radius / std::cos(M_PI / sides);
  vertices = {{0., 0., -0.5 * length}, {0., 0., 0.5 * length}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2. * M_PI * i / sides;
    for (const double end : {-0.5, 0.5}) {
      vertices.emplace_back(outer * std::cos(angle), outer * std::sin(angle), end * length);
    }
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
    triangles.insert(triangles.end(), {{0, b, a}, {1, a + 1, b + 1}, {a, b, b + 1}, {a, b + 1, a + 1}});
  }
}
} // namespace

vpBodyMesh vpMakeBodyMesh(const vpArmSpec &arm, int body)
{
  vpBodyMesh result;
  Vertices all;
  Triangles triangles;
  for (const vpArmShape &shape : arm.shapes) {
    if (shape.body != body) {
      continue;
    }
    Vertices vertices;
    Triangles own;
    if (shape.kind == vpArmShapeKind::Sphere) {
      result.spheres.push_back({0, shape.pose.p, shape.pose.p, shape.size(0), body});
    }
    else if (shape.kind == vpArmShapeKind::Mesh) {
      const vpTriangleMesh mesh = vpTriangleMesh::load(shape.file, shape.size);
      vertices = mesh.vertices();
      own = mesh.triangles();
    }
    else {
      shape.kind == vpArmShapeKind::Box ? addBox(shape.size, vertices, own)
                                        : addCylinder(shape.size(0), shape.size(1), vertices, own);
    }
    const int first = static_cast<int>(all.size());
    for (const Eigen::Vector3d &v : vertices) {
      all.emplace_back(shape.pose.R * v + shape.pose.p);
    }
    for (const auto &t : own) {
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  if (!triangles.empty()) {
    result.mesh.emplace(all, triangles, arm.bodies[static_cast<std::size_t>(body)].name);
  }
  return result;
}

END_VISP_NAMESPACE
