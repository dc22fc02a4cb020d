/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Octrees, and the tree of boxes by which they and meshes are searched.
#include "vpSegmentNearest.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <algorithm>
#include <numeric>

BEGIN_VISP_NAMESPACE

vpBoxTree::vpBoxTree(const std::vector<Item> &items) : m_order(items.size())
{
  if (items.empty()) {
    return;
  }
  std::iota(m_order.begin(), m_order.end(), 0);
  m_nodes.reserve(2 * items.size());
  m_nodes.emplace_back();
  split(0, 0, static_cast<int>(items.size()), items);
}

void vpBoxTree::split(std::size_t node, int first, int count, const std::vector<Item> &items)
{
  constexpr int leafSize = 3;
  const auto begin = m_order.begin() + first, end = begin + count;
  Eigen::Vector3d low = items[static_cast<std::size_t>(*begin)].low,
                  high = items[static_cast<std::size_t>(*begin)].high;
  for (auto i = begin; i != end; ++i) {
    low = low.cwiseMin(items[static_cast<std::size_t>(*i)].low);
    high = high.cwiseMax(items[static_cast<std::size_t>(*i)].high);
  }
  m_nodes[node].centre = 0.5 * (low + high);
  // Slightly enlarged, so that rounding cannot make the distance bound too large.
  m_nodes[node].half = 0.5 * (high - low) +
                       Eigen::Vector3d::Constant(1e-14 * (1. + high.cwiseAbs().maxCoeff() + low.cwiseAbs().maxCoeff()));
  if (count <= leafSize) {
    m_nodes[node].first = first;
    m_nodes[node].count = count;
    return;
  }
  int axis = 0;
  static_cast<void>((high - low).maxCoeff(&axis));
  const auto middle = begin + count / 2;
  std::nth_element(begin, middle, end, [&items, axis](int a, int b) {
    const Item &x = items[static_cast<std::size_t>(a)], &y = items[static_cast<std::size_t>(b)];
    return x.low(axis) + x.high(axis) < y.low(axis) + y.high(axis);
  });
  const std::size_t child = m_nodes.size();
  m_nodes[node].first = static_cast<int>(child);
  m_nodes[node].count = 0;
  m_nodes.emplace_back();
  m_nodes.emplace_back();
  split(child, first, count / 2, items);
  split(child + 1, first + count / 2, count - count / 2, items);
}

vpOctree::vpOctree(const std::vector<vpOctreeCell> &cells, const std::string &label)
{
  auto data = std::make_shared<vpOctreeData>();
  data->label = label;
  data->cells = cells;
  std::vector<vpBoxTree::Item> items;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const vpOctreeCell &cell = cells[i];
    if (!(cell.centre.cwiseAbs().array() <= vpLargestLength).all() || !(cell.size <= vpLargestLength) ||
        !(cell.size > 0.)) {
      throw vpException(vpException::badValue, "%s: cell %lu has the size %g m, must be > 0, and all within %g m",
                        label.c_str(), static_cast<unsigned long>(i), cell.size, vpLargestLength);
    }
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * cell.size);
    items.push_back({cell.centre - half, cell.centre + half});
  }
  data->tree = vpBoxTree(items);
  m_data = data;
}

const std::vector<vpOctreeCell> &vpOctree::cells() const &noexcept { return m_data->cells; }
const std::string &vpOctree::label() const noexcept { return m_data->label; }

vpNearestPoints vpOctreeData::nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                      double cutoff) const noexcept
{
  int index = -1;
  const auto exact = [&](int i) {
    const vpOctreeCell &cell = cells[static_cast<std::size_t>(i)];
    vpNearestPoints near =
        vpSegmentNearest::box(from - cell.centre, to - cell.centre, Eigen::Vector3d::Constant(0.5 * cell.size));
    near.onSegment += cell.centre;
    near.onOther += cell.centre;
    return near;
  };
  vpNearestPoints best = tree.nearest(from, to, cutoff, exact, index);
  if (index < 0) {
    best.distance = std::numeric_limits<double>::infinity();
  }
  return best;
}

END_VISP_NAMESPACE
