/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpObjectTree.h"

#include <algorithm>
#include <numeric>

BEGIN_VISP_NAMESPACE

namespace
{
using Nodes = std::vector<vpObjectNode>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Eigen::AlignedBox3d boxOf(const vpCollisionCore &core)
{
  const Eigen::Array33d R = core.pose.R.array().abs();
  Eigen::Array3d half = Eigen::Array3d::Constant(core.bound);
  switch (core.type) {
  case vpShapeType::Box:
    half = (R.matrix() * core.half).array();
    break;
  case vpShapeType::Capsule:
    half = core.half.z() * R.col(2);
    break;
  case vpShapeType::Cylinder:
    half = core.half.z() * R.col(2) + core.half.x() * (1. - R.col(2).square()).max(0.).sqrt();
    break;
  default:
    break;
  }
  // Rounding: poses are rigid to 1e-6 at worst.
  half = half * (1. + 2e-6) + core.radius + 1e-9 + 1e-14 * core.centre.array().abs();
  return {core.centre - half.matrix(), core.centre + half.matrix()};
}

void fit(vpObjectNode &node, const vpCollisionCore &core, const vpTwist &velocity)
{
  node.box = boxOf(core);
  node.fastest = velocity.linearNorm() + velocity.angularNorm() * core.reach();
}

void fit(vpObjectNode &node, const Nodes &nodes)
{
  const vpObjectNode &left = nodes[at(node.left)], &right = nodes[at(node.right)];
  node.box = left.box.merged(right.box);
  node.fastest = std::max(left.fastest, right.fastest);
}

// The node over the objects first..last - 1, split at the median of the axis on which their centres spread most.
int split(std::vector<int>::iterator first, std::vector<int>::iterator last, Nodes &nodes)
{
  if (last - first == 1) {
    return *first;
  }
  Eigen::AlignedBox3d centres;
  for (auto i = first; i != last; ++i) {
    centres.extend(nodes[at(*i)].box.center());
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const auto middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&nodes, axis](int a, int b) {
    return nodes[at(a)].box.center()[axis] < nodes[at(b)].box.center()[axis];
  });
  vpObjectNode node;
  node.left = split(first, middle, nodes);
  node.right = split(middle, last, nodes);
  fit(node, nodes);
  const int index = static_cast<int>(nodes.size());
  nodes[at(node.left)].parent = nodes[at(node.right)].parent = index;
  nodes.push_back(node);
  return index;
}
} // namespace

void vpBuildObjectTree(const std::vector<vpCollisionCore> &cores, const std::vector<vpCollisionObject> &objects,
                       Nodes &nodes)
{
  nodes.assign(cores.size(), vpObjectNode());
  nodes.reserve(2 * cores.size());
  vpFitObjectTree(cores, objects, nodes);
  std::vector<int> order(cores.size());
  std::iota(order.begin(), order.end(), 0);
  if (!order.empty()) {
    split(order.begin(), order.end(), nodes);
  }
}

void vpFitObjectTree(const std::vector<vpCollisionCore> &cores, const std::vector<vpCollisionObject> &objects,
                     Nodes &nodes) noexcept
{
  for (std::size_t j = 0; j < cores.size(); ++j) {
    fit(nodes[j], cores[j], objects[j].velocity);
  }
  for (std::size_t i = cores.size(); i < nodes.size(); ++i) { // those below a node come before it
    fit(nodes[i], nodes);
  }
}

void vpFitObject(int object, const vpCollisionCore &core, const vpTwist &velocity, Nodes &nodes) noexcept
{
  fit(nodes[at(object)], core, velocity);
  for (int i = nodes[at(object)].parent; i >= 0; i = nodes[at(i)].parent) {
    fit(nodes[at(i)], nodes);
  }
}

END_VISP_NAMESPACE
