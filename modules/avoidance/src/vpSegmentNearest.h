/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Nearest points of a segment to simple bodies, triangle meshes and octrees: vpSegmentDistance without its input check,
// for numbers known to be finite and of plausible magnitude.
#ifndef vpSegmentNearest_h
#define vpSegmentNearest_h

#include <visp3/avoidance/vpOctree.h>
#include <visp3/avoidance/vpSegmentDistance.h>
#include <visp3/avoidance/vpTriangleMesh.h>

#include <cstdint>
#include <limits>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace vpSegmentNearest
{
vpNearestPoints point(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &other) noexcept;
vpNearestPoints segment(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &otherFrom,
                        const Eigen::Vector3d &otherTo) noexcept;
vpNearestPoints box(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &half) noexcept;
vpNearestPoints cylinder(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double radius, double half) noexcept;
vpNearestPoints triangle(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &a,
                         const Eigen::Vector3d &b, const Eigen::Vector3d &c) noexcept;
} // namespace vpSegmentNearest

struct vpBoxTreeNode {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  int first = 0; // Leaf: first item in the order; otherwise the left child; the right one follows it.
  int count = 0; // Number of items of a leaf; 0 for an inner node.
};

// Tree of axis-aligned boxes over the triangles of a mesh or the cubes of an octree, to find the nearest to a segment: space
// is halved along the axes in turn, at the same planes everywhere (a radix tree over the places on a Z-order curve, which
// one sort makes: \cite Lauterbach09).
class vpBoxTree
{
public:
  struct Item {
    Eigen::Vector3d low, high;
  };

  vpBoxTree() = default;
  explicit vpBoxTree(const std::vector<Item> &items);

  [[nodiscard]] bool empty() const noexcept { return m_nodes.empty(); }
  [[nodiscard]] bool contains(const Eigen::Vector3d &p) const noexcept
  {
    return !empty() && ((p - m_nodes[0].centre).cwiseAbs().array() <= m_nodes[0].half.array()).all();
  }
  // Bounding sphere of all items.
  [[nodiscard]] Eigen::Vector3d centre() const noexcept
  {
    return empty() ? Eigen::Vector3d::Zero().eval() : m_nodes[0].centre;
  }
  [[nodiscard]] double radius() const noexcept { return empty() ? 0. : m_nodes[0].half.norm(); }

  /*
   * Nearest item to the segment within cutoff; index -1 if there is none. exact(i) gives the
   * vpNearestPoints of item i; the search ends at a distance of 0.
   */
  template <class Exact>
  vpNearestPoints nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double cutoff, Exact exact,
                          int &index) const noexcept
  {
    vpNearestPoints best;
    best.distance = cutoff;
    index = -1;
    if (empty()) {
      return best;
    }
    // The stack holds one node per level.
    struct Entry {
      int node;
      double bound;
    };
    Entry stack[mostLevels];
    int size = 0;
    stack[size++] = {0, bound(0, from, to)};
    while (size > 0) {
      const Entry entry = stack[--size];
      if (!(entry.bound < best.distance)) {
        continue;
      }
      const vpBoxTreeNode &node = m_nodes[static_cast<std::size_t>(entry.node)];
      for (int i = node.first; i < node.first + node.count; ++i) {
        const int item = m_order[static_cast<std::size_t>(i)];
        const vpNearestPoints now = exact(item);
        if (now.distance < best.distance) {
          best = now;
          index = item;
        }
      }
      if (node.count == 0) {
        const Entry left{node.first, bound(node.first, from, to)},
            right{node.first + 1, bound(node.first + 1, from, to)};
        const bool leftFirst = left.bound <= right.bound;
        stack[size++] = leftFirst ? right : left;
        stack[size++] = leftFirst ? left : right;
      }
    }
    return best;
  }

private:
  // A level for each bit of a code, then one for each halving of items with the same code.
  static constexpr int mostLevels = 48 + 32 + 1;

  [[nodiscard]] double bound(int i, const Eigen::Vector3d &from, const Eigen::Vector3d &to) const noexcept
  {
    const vpBoxTreeNode &node = m_nodes[static_cast<std::size_t>(i)];
    return vpSegmentNearest::box(from - node.centre, to - node.centre, node.half).distance;
  }
  // Items in the order, with the places of their middles, and the highest bit in which these may differ.
  struct Part {
    const std::uint64_t *codes;
    int first, count, top;
  };
  Item split(std::size_t node, Part part, const std::vector<Item> &items);

  std::vector<vpBoxTreeNode> m_nodes;
  std::vector<int> m_order;
};

struct vpOctreeData {
  std::string label;
  std::vector<vpOctreeCell> cells;
  vpBoxTree tree;

  // Nearest points to a segment in the map's frame, never negative. Infinite, without points, beyond the cutoff.
  [[nodiscard]] vpNearestPoints nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                        double cutoff) const noexcept;
};

struct vpTriangleMeshData {
  std::string label, message;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  bool watertight = false;
  vpBoxTree tree;
  // Normals for the sign (Baerentzen and Aanaes, 2005): of the face, of the edges 01, 12, 20, of the vertices weighted
  // by angle.
  std::vector<Eigen::Vector3d> faceNormals, vertexNormals;
  std::vector<std::array<Eigen::Vector3d, 3>> edgeNormals;

  // Nearest points to a segment in the mesh's frame; negative distance if the segment is inside a watertight mesh.
  // Infinite, without points, if nothing is within the cutoff.
  [[nodiscard]] vpNearestPoints nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                        double cutoff) const noexcept;
};

END_VISP_NAMESPACE
#endif
