/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// How the tree of boxes by which octrees and meshes are searched is built.
#include "vpSegmentNearest.h"

#include <algorithm>
#include <array>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int leafSize = 3;
constexpr int axisBits = 16; // of a coordinate in a code
constexpr int digitBits = 12, digits = 4, digitValues = 1 << digitBits;

// An item and the place of its middle on a Z-order curve.
struct Place {
  std::uint64_t code;
  int item;
};

void extend(vpBoxTree::Item &box, const vpBoxTree::Item &by)
{
  box.low = box.low.cwiseMin(by.low);
  box.high = box.high.cwiseMax(by.high);
}

// Two zeros behind each of the 16 lowest bits.
std::uint64_t spread(std::uint64_t x)
{
  x = (x | x << 16) & 0x0000ff0000ffU;
  x = (x | x << 8) & 0x00f00f00f00fU;
  x = (x | x << 4) & 0x0c30c30c30c3U;
  return (x | x << 2) & 0x249249249249U;
}

std::vector<Place> placesOf(const std::vector<vpBoxTree::Item> &items)
{
  Eigen::Vector3d low = items[0].low + items[0].high, high = low;
  for (const vpBoxTree::Item &item : items) {
    low = low.cwiseMin(item.low + item.high);
    high = high.cwiseMax(item.low + item.high);
  }
  const double size = (high - low).maxCoeff(), most = (1 << axisBits) - 1;
  const double scale = size > 0. ? most / size : 0.;
  std::vector<Place> places(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Eigen::Vector3d at = (scale * (items[i].low + items[i].high - low)).cwiseMax(0.).cwiseMin(most);
    places[i] = {spread(static_cast<std::uint64_t>(at.x())) | spread(static_cast<std::uint64_t>(at.y())) << 1 |
                     spread(static_cast<std::uint64_t>(at.z())) << 2,
                 static_cast<int>(i)};
  }
  return places;
}

std::size_t digitOf(std::uint64_t code, int digit) { return code >> (digit * digitBits) & (digitValues - 1); }

// By code, stable: a pass for each digit that differs.
void sortByCode(std::vector<Place> &places)
{
  std::vector<std::array<std::uint32_t, digitValues>> counts(digits);
  for (const Place &place : places) {
    for (int d = 0; d < digits; ++d) {
      ++counts[static_cast<std::size_t>(d)][digitOf(place.code, d)];
    }
  }
  std::vector<Place> sorted(places.size());
  for (int d = 0; d < digits; ++d) {
    std::array<std::uint32_t, digitValues> &next = counts[static_cast<std::size_t>(d)];
    if (next[digitOf(places[0].code, d)] == places.size()) {
      continue;
    }
    std::uint32_t begin = 0;
    for (std::uint32_t &count : next) {
      begin += std::exchange(count, begin);
    }
    for (const Place &place : places) {
      sorted[next[digitOf(place.code, d)]++] = place;
    }
    places.swap(sorted);
  }
}

// Number of codes below the highest bit, at most top, in which the first and the last of them differ; half of them if none
// does. Then top is the next bit to look at.
int lowerPart(const std::uint64_t *codes, int count, int &top)
{
  const std::uint64_t different = codes[0] ^ codes[count - 1];
  while (top >= 0 && (different >> top & 1) == 0) {
    --top;
  }
  if (top < 0) {
    return count / 2;
  }
  const std::uint64_t bit = std::uint64_t{1} << top--;
  return static_cast<int>(
      std::partition_point(codes, codes + count, [bit](std::uint64_t c) { return (c & bit) == 0; }) - codes);
}
} // namespace

vpBoxTree::vpBoxTree(const std::vector<Item> &items)
{
  if (items.empty()) {
    return;
  }
  std::vector<Place> places = placesOf(items);
  sortByCode(places);
  std::vector<std::uint64_t> codes;
  codes.reserve(places.size());
  m_order.reserve(places.size());
  for (const Place &place : places) {
    codes.push_back(place.code);
    m_order.push_back(place.item);
  }
  m_nodes.reserve(2 * items.size());
  m_nodes.emplace_back();
  split(0, {codes.data(), 0, static_cast<int>(items.size()), 3 * axisBits - 1}, items);
}

// Returns the box of the node.
vpBoxTree::Item vpBoxTree::split(std::size_t node, Part part, const std::vector<Item> &items)
{
  const auto item = [&](int i) { return items.begin() + m_order[static_cast<std::size_t>(i)]; };
  Item box;
  if (part.count <= leafSize) {
    box = *item(part.first);
    for (int i = part.first + 1; i < part.first + part.count; ++i) {
      extend(box, *item(i));
    }
    m_nodes[node].first = part.first;
    m_nodes[node].count = part.count;
  }
  else {
    const std::size_t child = m_nodes.size();
    m_nodes[node].first = static_cast<int>(child);
    m_nodes.emplace_back();
    m_nodes.emplace_back();
    const int lower = lowerPart(part.codes + part.first, part.count, part.top);
    box = split(child, {part.codes, part.first, lower, part.top}, items);
    extend(box, split(child + 1, {part.codes, part.first + lower, part.count - lower, part.top}, items));
  }
  m_nodes[node].centre = 0.5 * (box.low + box.high);
  // Slightly enlarged, so that rounding cannot make the distance bound too large.
  m_nodes[node].half =
      0.5 * (box.high - box.low) +
      Eigen::Vector3d::Constant(1e-14 * (1. + box.high.cwiseAbs().maxCoeff() + box.low.cwiseAbs().maxCoeff()));
  return box;
}

END_VISP_NAMESPACE
