/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Cells of a mesh that a cover must enclose, and the geometry that its fit, proof and measures share.
#ifndef vpCoverCells_h
#define vpCoverCells_h

#include "vpSegmentNearest.h"

#include <visp3/manipulator/vpArmSpec.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace vpCover
{
using Points = std::vector<Eigen::Vector3d>;

constexpr double rounding = 1e-9; // added to every fitted radius, m

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Squared distance from the segment from + [0, 1] along.
inline double squaredDistance(const Eigen::Vector3d &p, const Eigen::Vector3d &from, const Eigen::Vector3d &along,
                              double squaredLength)
{
  const Eigen::Vector3d w = p - from;
  const double s = squaredLength > 0. ? std::clamp(w.dot(along) / squaredLength, 0., 1.) : 0.;
  return (w - s * along).squaredNorm();
}
inline double axisDistance(const Eigen::Vector3d &p, const vpArmCapsule &c)
{
  const Eigen::Vector3d along = c.to - c.from;
  return std::sqrt(squaredDistance(p, c.from, along, along.squaredNorm()));
}
// Distance of a point from the union of capsules; negative inside.
double distance(const Eigen::Vector3d &p, const std::vector<vpArmCapsule> &capsules);
// Largest distance of the points from a segment.
double farthest(const Points &points, const Eigen::Vector3d &from, const Eigen::Vector3d &to);
// Unit vectors, evenly spread on a spiral.
Points directions(int count);

// A triangle (3 corners) or a cube of the inside (8).
struct Cell {
  std::array<int, 8> corners{};
  std::size_t size = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

struct Cells {
  Points points;
  std::vector<Cell> cells;

  // Throws vpException (badValue) naming the mesh if there are too many.
  explicit Cells(const vpTriangleMesh &mesh);
};

// How often the mesh winds around a point: 1 inside a closed surface, in between near holes.
double windingNumber(const vpTriangleMesh &mesh, const Eigen::Vector3d &p);

struct Place {
  double distance = 0.; // from the surface, m, >= 0
  bool inside = false;  // of a solid; at a mesh with holes, winding number > 1/2
};
Place placeOf(const vpTriangleMesh &mesh, const Eigen::Vector3d &p);

inline Eigen::AlignedBox3d boxOf(const vpTriangleMesh &mesh)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d &v : mesh.vertices()) {
    box.extend(v);
  }
  return box;
}

// False if the capsules certainly enclose no hollow, see vpProveCover().
bool mayHaveHollow(const std::vector<vpArmCapsule> &capsules);
} // namespace vpCover

END_VISP_NAMESPACE
#endif
