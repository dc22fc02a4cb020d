/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A tree of boxes over the objects of a scene: which of them can be near a part of the arm.
#ifndef vpObjectTree_h
#define vpObjectTree_h

#include "vpCollisionCore.h"

#include <Eigen/Geometry>

#include <array>
#include <vector>

BEGIN_VISP_NAMESPACE

//! A node of the tree: an object, or everything below two other nodes. The nodes of the objects come first, in the
//! order of the objects; the last node is the root.
struct vpObjectNode {
  Eigen::AlignedBox3d box; // In the base, with radius and inflation.
  double fastest = 0.;     // Largest speed of any point within, m/s.
  int parent = -1;
  int left = -1, right = -1; // -1: an object.
};

//! Builds the tree. Allocates.
void vpBuildObjectTree(const std::vector<vpCollisionCore> &cores, const std::vector<vpCollisionObject> &objects,
                       std::vector<vpObjectNode> &nodes);

//! Fits all nodes to the poses, radii and velocities of the objects. The shape of the tree remains.
void vpFitObjectTree(const std::vector<vpCollisionCore> &cores, const std::vector<vpCollisionObject> &objects,
                     std::vector<vpObjectNode> &nodes) noexcept;

//! The same for one object that has changed.
void vpFitObject(int object, const vpCollisionCore &core, const vpTwist &velocity,
                 std::vector<vpObjectNode> &nodes) noexcept;

//! Largest speed of any point of any object, m/s.
inline double vpFastestObject(const std::vector<vpObjectNode> &nodes) noexcept
{
  return nodes.empty() ? 0. : nodes.back().fastest;
}

//! Gap between two boxes along the axis on which it is largest: at most the signed distance of what they enclose.
inline double vpGapOf(const Eigen::AlignedBox3d &a, const Eigen::AlignedBox3d &b) noexcept
{
  return (a.min() - b.max()).cwiseMax(b.min() - a.max()).maxCoeff();
}

//! The objects near a box, the nearer part of the tree first.
class vpObjectSearch
{
public:
  /*
   * \param nodes : Must outlive this.
   * \param around : In the base.
   * \param time : s from now; the boxes of objects are enlarged by what these move until then.
   */
  vpObjectSearch(const std::vector<vpObjectNode> &nodes, const Eigen::AlignedBox3d &around, double time) noexcept
    : m_nodes(nodes), m_around(around), m_time(std::abs(time))
  {
    if (!nodes.empty()) {
      push(static_cast<int>(nodes.size()) - 1);
    }
  }

  //! The next object whose gap from the box is at most \e cutoff, which may become smaller from call to call; -1 at the
  //! end.
  [[nodiscard]] int next(double cutoff) noexcept
  {
    while (m_count > 0) {
      const Open top = m_open[--m_count];
      if (top.gap > cutoff) {
        continue;
      }
      const vpObjectNode &node = m_nodes[static_cast<std::size_t>(top.node)];
      if (node.left < 0) {
        return top.node;
      }
      push(node.left);
      push(node.right);
      Open &last = m_open[m_count - 1], &before = m_open[m_count - 2];
      if (last.gap > before.gap) {
        std::swap(last, before);
      }
    }
    return -1;
  }

private:
  struct Open {
    int node;
    double gap;
  };
  void push(int node) noexcept
  {
    const vpObjectNode &n = m_nodes[static_cast<std::size_t>(node)];
    m_open[m_count++] = {node, vpGapOf(n.box, m_around) - n.fastest * m_time};
  }

  const std::vector<vpObjectNode> &m_nodes;
  const Eigen::AlignedBox3d m_around;
  const double m_time;
  std::array<Open, 40> m_open; // one per level of a balanced tree, and one
  std::size_t m_count = 0;
};

END_VISP_NAMESPACE
#endif
