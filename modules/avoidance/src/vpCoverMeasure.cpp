/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCoverMeasure.h"

#include <Eigen/Geometry>

#include <random>
#include <set>

BEGIN_VISP_NAMESPACE

namespace vpCover
{
namespace
{
// Samples of the surface of a capsule: a spiral on the caps, rings on the tube.
Points surfaceOf(const vpArmCapsule &c)
{
  const Eigen::Vector3d along = c.to - c.from;
  const double length = along.norm();
  Points samples;
  for (const Eigen::Vector3d &u : directions(800)) {
    samples.push_back((length > 0. && u.dot(along) > 0. ? c.to : c.from) + c.radius * u);
  }
  if (length > 0.) {
    const Eigen::Vector3d x = along.unitOrthogonal(), y = along.normalized().cross(x);
    const int rings = 16, points = 32;
    for (int i = 0; i <= rings; ++i) {
      for (int k = 0; k < points; ++k) {
        const double angle = 2. * M_PI * k / points;
        samples.push_back(c.from + along * i / rings + c.radius * (std::cos(angle) * x + std::sin(angle) * y));
      }
    }
  }
  return samples;
}

// The farthest vertices in the given directions.
Points supports(const Points &vertices, const Points &axes)
{
  std::set<std::size_t> chosen;
  for (const Eigen::Vector3d &d : axes) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      best = d.dot(vertices[i]) > d.dot(vertices[best]) ? i : best;
    }
    chosen.insert(best);
  }
  Points result;
  for (const std::size_t i : chosen) {
    result.push_back(vertices[i]);
  }
  return result;
}

using Facets = std::vector<std::array<int, 3>>;

// Volume of the tetrahedron below a facet, times 6; > 0 if p lies below it.
double sixfold(const Points &p, const std::array<int, 3> &f, const Eigen::Vector3d &tip)
{
  const Eigen::Vector3d &a = p[at(f[0])];
  return (p[at(f[1])] - a).dot((p[at(f[2])] - a).cross(a - tip));
}

// Adds a point to a convex hull: what it sees is replaced by facets between it and the horizon.
void extend(Facets &hull, const Points &points, int added)
{
  Facets kept;
  std::set<std::pair<int, int>> edges;
  for (const auto &f : hull) {
    if (sixfold(points, f, points[at(added)]) >= 0.) {
      kept.push_back(f);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::pair<int, int> edge{f[k], f[(k + 1) % 3]};
      if (edges.erase({edge.second, edge.first}) == 0) { // between two facets that are both seen
        edges.insert(edge);
      }
    }
  }
  for (const auto &edge : edges) {
    kept.push_back({edge.first, edge.second, added});
  }
  hull = kept;
}
} // namespace

double overhangOf(const vpTriangleMesh &mesh, const std::vector<vpArmCapsule> &capsules)
{
  double most = 0.;
  for (std::size_t j = 0; j < capsules.size(); ++j) {
    for (const Eigen::Vector3d &p : surfaceOf(capsules[j])) {
      const double hidden = -1e-9; // the surface of its own capsule is not
      if (distance(p, capsules) < hidden) {
        continue;
      }
      const double d = mesh.data().nearest(p, p, std::numeric_limits<double>::infinity()).distance;
      if (d > most && !placeOf(mesh, p).inside) {
        most = d;
      }
    }
  }
  return most;
}

// Share of a box that is in the capsules, times its volume.
double unionVolume(const std::vector<vpArmCapsule> &capsules)
{
  Eigen::AlignedBox3d box;
  for (const vpArmCapsule &c : capsules) {
    const Eigen::Vector3d r = Eigen::Vector3d::Constant(c.radius);
    box.extend(c.from - r).extend(c.from + r).extend(c.to - r).extend(c.to + r);
  }
  const int n = 60;
  const Eigen::Vector3d step = box.sizes() / n;
  long inside = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const Eigen::Vector3d p = box.min() + step.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
        inside += std::any_of(capsules.begin(), capsules.end(),
                              [&p](const vpArmCapsule &c) { return axisDistance(p, c) <= c.radius; })
                      ? 1
                      : 0;
      }
    }
  }
  return static_cast<double>(inside) * step.prod();
}

// The hull is thinnest across one of its facets or between two edges.
double radiusOf(const vpTriangleMesh &mesh)
{
  const Points hull = supports(mesh.vertices(), directions(600));
  Points axes = directions(600);
  axes.insert(axes.end(), mesh.data().faceNormals.begin(), mesh.data().faceNormals.end());
  axes.insert(axes.end(), {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()});
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d &d : axes) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Eigen::Vector3d &p : hull) {
      low = std::min(low, d.dot(p));
      high = std::max(high, d.dot(p));
    }
    least = std::min(least, 0.5 * (high - low));
  }
  return least;
}

/*
 * Of the hull of the farthest vertices in 600 directions, so at most that of the mesh. Points are moved by 1e-6 of the
 * size, so that no four of them lie in a plane.
 */
double hullVolume(const vpTriangleMesh &mesh)
{
  Points points = supports(mesh.vertices(), directions(600));
  const Eigen::AlignedBox3d box = boxOf(mesh);
  std::mt19937_64 random(1);
  for (Eigen::Vector3d &p : points) {
    for (int i = 0; i < 3; ++i) {
      p(i) += 1e-6 * box.sizes().maxCoeff() * (0x1p-53 * static_cast<double>(random() >> 11U) - 0.5);
    }
  }
  if (points.size() < 4) {
    return 0.;
  }
  Facets hull{{0, 1, 2}, {0, 2, 1}};
  for (int i = 3; i < static_cast<int>(points.size()); ++i) {
    extend(hull, points, i);
  }
  double sum = 0.;
  for (const auto &f : hull) {
    sum += sixfold(points, f, points[0]);
  }
  const double volume = sum / 6.;
  return volume > 1e-5 * std::pow(box.sizes().maxCoeff(), 3) ? volume : 0.;
}

vpCapsuleCover measured(const vpTriangleMesh &mesh, const std::vector<vpArmCapsule> &capsules)
{
  vpCapsuleCover cover;
  cover.capsules = capsules;
  cover.overhang = overhangOf(mesh, capsules);
  const double hull = hullVolume(mesh);
  cover.volumeRatio = hull > 0. ? unionVolume(capsules) / hull : 0.;
  cover.radius = radiusOf(mesh);
  return cover;
}
} // namespace vpCover

END_VISP_NAMESPACE
