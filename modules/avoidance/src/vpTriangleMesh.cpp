/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpSegmentNearest.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
std::size_t at(int i) { return static_cast<std::size_t>(i); }

double angleAt(const Eigen::Vector3d &corner, const Eigen::Vector3d &a, const Eigen::Vector3d &b)
{
  return std::atan2((a - corner).cross(b - corner).norm(), (a - corner).dot(b - corner));
}

// Formats repeat a vertex in every triangle, or at texture seams: without merging every edge would be a hole.
std::vector<int> joinVertices(const std::vector<Eigen::Vector3d> &vertices, vpTriangleMeshData &data)
{
  std::map<std::array<double, 3>, int> known;
  std::vector<int> index;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d &v = vertices[i];
    if (!(v.cwiseAbs().array() <= vpLargestLength).all()) {
      throw vpException(vpException::badValue, "%s: vertex %lu is not within %g m", data.label.c_str(),
                        static_cast<unsigned long>(i), vpLargestLength);
    }
    const auto found = known.emplace(std::array<double, 3>{v.x(), v.y(), v.z()}, static_cast<int>(known.size()));
    if (found.second) {
      data.vertices.push_back(v);
    }
    index.push_back(found.first->second);
  }
  return index;
}

void takeTriangles(const std::vector<std::array<int, 3>> &triangles, const std::vector<int> &joined,
                   vpTriangleMeshData &data)
{
  const int n = static_cast<int>(joined.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<int, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int index = triangles[i][k];
      if (index < 0 || index >= n) {
        throw vpException(vpException::badValue, "%s: triangle %lu uses vertex %d of %d", data.label.c_str(),
                          static_cast<unsigned long>(i), index, n);
      }
      t[k] = joined[at(index)];
    }
    const auto &v = data.vertices;
    const Eigen::Vector3d a = v[at(t[0])], b = v[at(t[1])], c = v[at(t[2])];
    if ((b - a).cross(c - a).norm() > 1e-30) {
      data.triangles.push_back(t);
    }
  }
  if (data.triangles.empty()) {
    throw vpException(vpException::badValue, "%s: there is no triangle with an area", data.label.c_str());
  }
}

using Triangles = std::vector<std::array<int, 3>>;

//! Edges, their ends in ascending order, and the triangles that have them.
using Edges = std::map<std::pair<int, int>, std::vector<int>>;

struct Shell {
  std::vector<int> triangles;
  bool turned = false; // some of its triangles were reversed
  double volume = 0.;  // times 6; > 0: outwards
  Eigen::AlignedBox3d box;
};

std::pair<int, int> edgeOf(const std::array<int, 3> &t, std::size_t k) { return std::minmax({t[k], t[(k + 1) % 3]}); }

void turn(std::array<int, 3> &t) { std::swap(t[1], t[2]); }

// All triangles connected to the first one by edges of two triangles, with the same orientation.
Shell spread(int first, const Edges &edges, Triangles &triangles, std::vector<bool> &seen, int &twisted)
{
  Shell shell;
  shell.triangles.push_back(first);
  seen[at(first)] = true;
  for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
    const int here = shell.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangles[at(here)][k], to = triangles[at(here)][(k + 1) % 3];
      const std::vector<int> &uses = edges.at(edgeOf(triangles[at(here)], k));
      if (uses.size() != 2) {
        continue;
      }
      const int other = uses[0] == here ? uses[1] : uses[0];
      std::array<int, 3> &t = triangles[at(other)];
      // The neighbour should have the edge in the opposite direction.
      const bool same = (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
      if (!seen[at(other)]) {
        seen[at(other)] = true;
        shell.turned = shell.turned || same;
        same ? turn(t) : void();
        shell.triangles.push_back(other);
      }
      else {
        twisted += same ? 1 : 0;
      }
    }
  }
  return shell;
}

void measure(const std::vector<Eigen::Vector3d> &vertices, const Triangles &triangles, Shell &shell)
{
  const Eigen::Vector3d origin = vertices[at(triangles[at(shell.triangles[0])][0])];
  for (const int i : shell.triangles) {
    const std::array<int, 3> &t = triangles[at(i)];
    const Eigen::Vector3d a = vertices[at(t[0])], b = vertices[at(t[1])], c = vertices[at(t[2])];
    shell.volume += (a - origin).dot((b - origin).cross(c - origin));
    shell.box.extend(a).extend(b).extend(c);
  }
}

bool isCavity(const Shell &shell, const std::vector<Shell> &all)
{
  return !shell.turned && std::any_of(all.begin(), all.end(), [&shell](const Shell &other) {
    return &other != &shell && other.volume > 0. && other.box.contains(shell.box) && !shell.box.contains(other.box);
  });
}

// Whether the triangles are a solid.
struct Topology {
  int openEdges = 0;  // edges of one triangle
  int otherEdges = 0; // edges of more than two, or between triangles that cannot be oriented consistently
};

/*
 * Orients the triangles of each closed shell consistently outwards. A shell that is oriented inwards as a whole is
 * kept, as a cavity, if it lies within the bounds of another one; oriented outwards it would count as filled.
 */
Topology orient(const std::vector<Eigen::Vector3d> &vertices, Triangles &triangles)
{
  Edges edges;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges[edgeOf(triangles[i], k)].push_back(static_cast<int>(i));
    }
  }
  Topology topology;
  for (const auto &edge : edges) {
    topology.openEdges += edge.second.size() == 1 ? 1 : 0;
    topology.otherEdges += edge.second.size() > 2 ? 1 : 0;
  }
  if (topology.openEdges > 0 || topology.otherEdges > 0) {
    return topology;
  }
  std::vector<bool> seen(triangles.size(), false);
  std::vector<Shell> shells;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!seen[i]) {
      shells.push_back(spread(static_cast<int>(i), edges, triangles, seen, topology.otherEdges));
      measure(vertices, triangles, shells.back());
    }
  }
  for (const Shell &shell : shells) {
    if (shell.volume < 0. && !isCavity(shell, shells)) {
      for (const int i : shell.triangles) {
        turn(triangles[at(i)]);
      }
    }
  }
  return topology;
}

void judge(vpTriangleMeshData &data)
{
  const Topology topology = orient(data.vertices, data.triangles);
  data.watertight = topology.openEdges == 0 && topology.otherEdges == 0;
  if (topology.openEdges > 0) {
    data.message = data.label + ": the surface has holes (" + std::to_string(topology.openEdges) +
                   " edges with one triangle), it is a surface without an inside";
  }
  else if (topology.otherEdges > 0) {
    data.message = data.label + ": " + std::to_string(topology.otherEdges) +
                   " edges have more than two triangles or no two sides, it is a surface without an inside";
  }
}

void addNormals(vpTriangleMeshData &data)
{
  std::map<std::pair<int, int>, Eigen::Vector3d> edges;
  data.vertexNormals.assign(data.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto &t : data.triangles) {
    const std::array<Eigen::Vector3d, 3> corner = {data.vertices[at(t[0])], data.vertices[at(t[1])],
                                                   data.vertices[at(t[2])]};
    const Eigen::Vector3d n = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    data.faceNormals.push_back(n);
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace(edgeOf(t, k), Eigen::Vector3d::Zero()).first->second += n;
      data.vertexNormals[at(t[k])] += angleAt(corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]) * n;
    }
  }
  for (const auto &t : data.triangles) {
    data.edgeNormals.push_back({edges[edgeOf(t, 0)], edges[edgeOf(t, 1)], edges[edgeOf(t, 2)]});
  }
}

// Normal at a point of a triangle, of the edge or vertex if it lies on one.
Eigen::Vector3d normalAt(const vpTriangleMeshData &data, int triangle, const Eigen::Vector3d &p)
{
  const std::size_t i = static_cast<std::size_t>(triangle);
  const auto &t = data.triangles[i];
  const Eigen::Vector3d &a = data.vertices[at(t[0])], &b = data.vertices[at(t[1])], &c = data.vertices[at(t[2])];
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  // Barycentric weights; weight k vanishes on the edge opposite to vertex k.
  const std::array<double, 3> weight = {(c - b).cross(p - b).dot(n) / area, (a - c).cross(p - c).dot(n) / area,
                                        (b - a).cross(p - a).dot(n) / area};
  constexpr double on = 1e-9;
  for (std::size_t k = 0; k < 3; ++k) {
    if (weight[k] > 1. - on) {
      return data.vertexNormals[at(t[k])];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (weight[k] < on) {
      return data.edgeNormals[i][(k + 1) % 3];
    }
  }
  return data.faceNormals[i];
}
} // namespace

vpNearestPoints vpTriangleMeshData::nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                            double cutoff) const noexcept
{
  int index = -1;
  const auto exact = [&](int i) {
    const auto &t = triangles[at(i)];
    return vpSegmentNearest::triangle(from, to, vertices[at(t[0])], vertices[at(t[1])], vertices[at(t[2])]);
  };
  // A segment inside a solid may be farther from the surface than the cutoff, which must then be ignored.
  const bool mayBeInside = watertight && tree.contains(from);
  vpNearestPoints best =
      tree.nearest(from, to, mayBeInside ? std::numeric_limits<double>::infinity() : cutoff, exact, index);
  if (index < 0) {
    best.distance = std::numeric_limits<double>::infinity();
  }
  if (mayBeInside && index >= 0 && best.distance > 0. &&
      (best.onSegment - best.onOther).dot(normalAt(*this, index, best.onOther)) < 0.) {
    best.distance = -best.distance;
  }
  return best;
}

vpTriangleMesh::vpTriangleMesh(const std::vector<Eigen::Vector3d> &vertices,
                               const std::vector<std::array<int, 3>> &triangles, const std::string &label)
{
  auto data = std::make_shared<vpTriangleMeshData>();
  data->label = label;
  takeTriangles(triangles, joinVertices(vertices, *data), *data);
  judge(*data);
  addNormals(*data);
  std::vector<vpBoxTree::Item> items;
  for (const auto &t : data->triangles) {
    const Eigen::Vector3d &a = data->vertices[at(t[0])], &b = data->vertices[at(t[1])], &c = data->vertices[at(t[2])];
    items.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  data->tree = vpBoxTree(items);
  m_data = data;
}

const std::vector<Eigen::Vector3d> &vpTriangleMesh::vertices() const &noexcept { return m_data->vertices; }
const std::vector<std::array<int, 3>> &vpTriangleMesh::triangles() const &noexcept { return m_data->triangles; }
bool vpTriangleMesh::isWatertight() const noexcept { return m_data->watertight; }
const std::string &vpTriangleMesh::message() const noexcept { return m_data->message; }
const std::string &vpTriangleMesh::label() const noexcept { return m_data->label; }

END_VISP_NAMESPACE
