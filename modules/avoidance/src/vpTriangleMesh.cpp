/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMeshTopology.h"
#include "vpTriangleMeshData.h"

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
      t[k] = joined[static_cast<std::size_t>(index)];
    }
    const auto &v = data.vertices;
    const Eigen::Vector3d a = v[static_cast<std::size_t>(t[0])], b = v[static_cast<std::size_t>(t[1])],
                          c = v[static_cast<std::size_t>(t[2])];
    if ((b - a).cross(c - a).norm() > 1e-30) {
      data.triangles.push_back(t);
    }
  }
  if (data.triangles.empty()) {
    throw vpException(vpException::badValue, "%s: there is no triangle with an area", data.label.c_str());
  }
}

void judge(vpTriangleMeshData &data)
{
  const vpMeshTopology topology = vpOrientMesh(data.vertices, data.triangles);
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

using Edge = std::pair<int, int>;

Edge sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

void addNormals(vpTriangleMeshData &data)
{
  std::map<Edge, Eigen::Vector3d> edges;
  data.vertexNormals.assign(data.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto &t : data.triangles) {
    const std::array<Eigen::Vector3d, 3> corner = {data.vertices[static_cast<std::size_t>(t[0])],
                                                   data.vertices[static_cast<std::size_t>(t[1])],
                                                   data.vertices[static_cast<std::size_t>(t[2])]};
    const Eigen::Vector3d n = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    data.faceNormals.push_back(n);
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace(sorted(t[k], t[(k + 1) % 3]), Eigen::Vector3d::Zero()).first->second += n;
      data.vertexNormals[static_cast<std::size_t>(t[k])] +=
          angleAt(corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]) * n;
    }
  }
  for (const auto &t : data.triangles) {
    data.edgeNormals.push_back({edges[sorted(t[0], t[1])], edges[sorted(t[1], t[2])], edges[sorted(t[2], t[0])]});
  }
}

// Normal at a point of a triangle, of the edge or vertex if it lies on one.
Eigen::Vector3d normalAt(const vpTriangleMeshData &data, int triangle, const Eigen::Vector3d &p)
{
  const std::size_t i = static_cast<std::size_t>(triangle);
  const auto &t = data.triangles[i];
  const Eigen::Vector3d &a = data.vertices[static_cast<std::size_t>(t[0])],
                        &b = data.vertices[static_cast<std::size_t>(t[1])],
                        &c = data.vertices[static_cast<std::size_t>(t[2])];
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  // Barycentric weights; weight k vanishes on the edge opposite to vertex k.
  const std::array<double, 3> weight = {(c - b).cross(p - b).dot(n) / area, (a - c).cross(p - c).dot(n) / area,
                                        (b - a).cross(p - a).dot(n) / area};
  constexpr double on = 1e-9;
  for (std::size_t k = 0; k < 3; ++k) {
    if (weight[k] > 1. - on) {
      return data.vertexNormals[static_cast<std::size_t>(t[k])];
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
    const auto &t = triangles[static_cast<std::size_t>(i)];
    return vpSegmentNearest::triangle(from, to, vertices[static_cast<std::size_t>(t[0])],
                                      vertices[static_cast<std::size_t>(t[1])],
                                      vertices[static_cast<std::size_t>(t[2])]);
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
    const Eigen::Vector3d &a = data->vertices[static_cast<std::size_t>(t[0])],
                          &b = data->vertices[static_cast<std::size_t>(t[1])],
                          &c = data->vertices[static_cast<std::size_t>(t[2])];
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
