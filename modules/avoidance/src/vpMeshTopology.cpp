/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMeshTopology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
using Triangles = std::vector<std::array<int, 3>>;

using Edges = std::map<std::pair<int, int>, std::vector<int>>; // their triangles

struct Shell {
  std::vector<int> triangles;
  bool turned = false; // some of its triangles were reversed
  double volume = 0.;  // times 6; > 0: outwards
  Eigen::AlignedBox3d box;
};

std::size_t at(int i) { return static_cast<std::size_t>(i); }

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
} // namespace

vpMeshTopology vpOrientMesh(const std::vector<Eigen::Vector3d> &vertices, Triangles &triangles)
{
  Edges edges;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges[edgeOf(triangles[i], k)].push_back(static_cast<int>(i));
    }
  }
  vpMeshTopology topology;
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

END_VISP_NAMESPACE
