/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpBoxTree.h"

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

END_VISP_NAMESPACE
