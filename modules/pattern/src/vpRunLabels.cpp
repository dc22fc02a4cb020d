/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpRunLabels.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

BEGIN_VISP_NAMESPACE

vpRunLabels::vpRunLabels(unsigned int width, unsigned int height, std::size_t maxSpots)
  : m_width(static_cast<int>(width)), m_height(static_cast<int>(height)), m_maxSpots(maxSpots)
{
  const std::size_t runs = static_cast<std::size_t>(width) * height / 6 + 64;
  m_runs.reserve(runs);
  m_parent.reserve(runs);
  m_boxes.reserve(runs);
  m_spots.reserve(maxSpots);
}

int vpRunLabels::root(int label)
{
  while (m_parent[static_cast<std::size_t>(label)] != label) {
    label = m_parent[static_cast<std::size_t>(label)];
  }
  return label;
}

void vpRunLabels::join(int a, int b)
{
  a = root(a);
  b = root(b);
  m_parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

bool vpRunLabels::scanRow(const unsigned char *row, int threshold, bool bright)
{
  const auto isSpot = [=](int x) { return (row[x] > threshold) == bright; };
  // Eight pixels at a time: adding 127 - t to the low seven bits sets the top bit where they exceed t.
  const std::uint64_t ones = 0x0101010101010101u, top = 0x8080808080808080u;
  const std::uint64_t add = ones * static_cast<unsigned>(127 - (threshold & 127));
  int x = 0;
  bool inside = false;
  int begin = 0;
  const auto change = [&](int at) {
    if (inside) {
      if (m_runs.size() == m_runs.capacity()) {
        return false;
      }
      m_runs.push_back({begin, at, -1});
    }
    else {
      begin = at;
    }
    inside = !inside;
    return true;
  };
  for (; x + 8 <= m_width; x += 8) {
    std::uint64_t v;
    std::memcpy(&v, row + x, 8);
    const std::uint64_t low = (v & ~top) + add;
    const std::uint64_t above = (threshold < 128 ? (low | v) : (low & v)) & top;
    const std::uint64_t bits = bright ? above : above ^ top;
    if (bits == (inside ? top : 0)) {
      continue;
    }
    for (int i = x; i < x + 8; ++i) {
      if (isSpot(i) != inside && !change(i)) {
        return false;
      }
    }
  }
  for (; x < m_width; ++x) {
    if (isSpot(x) != inside && !change(x)) {
      return false;
    }
  }
  return !inside || change(m_width);
}

bool vpRunLabels::find(const vpImage<unsigned char> &image, int threshold, bool bright, int minArea)
{
  m_runs.clear();
  m_parent.clear();
  m_boxes.clear();
  m_spots.clear();
  std::size_t above = 0, aboveEnd = 0;
  for (int y = 0; y < m_height; ++y) {
    const std::size_t begin = m_runs.size();
    if (!scanRow(image[static_cast<unsigned int>(y)], threshold, bright)) {
      return false;
    }
    // Runs of this row and of the one above, both from left to right: four-connected when their columns overlap.
    for (std::size_t i = begin; i < m_runs.size(); ++i) {
      Run &run = m_runs[i];
      while (above < aboveEnd && m_runs[above].end <= run.begin) {
        ++above;
      }
      for (std::size_t k = above; k < aboveEnd && m_runs[k].begin < run.end; ++k) {
        if (run.label < 0) {
          run.label = root(m_runs[k].label);
        }
        else if (run.label != m_runs[k].label) {
          join(run.label, m_runs[k].label);
        }
      }
      if (run.label < 0) {
        run.label = static_cast<int>(m_parent.size());
        m_parent.push_back(run.label);
        m_boxes.emplace_back();
        m_boxes.back() = {run.begin, run.end - 1, y, y, 0, 0., 0.};
      }
      vpPatternSpot &box = m_boxes[static_cast<std::size_t>(run.label)];
      box.left = std::min(box.left, run.begin);
      box.right = std::max(box.right, run.end - 1);
      box.bottom = y;
      box.area += run.end - run.begin;
    }
    above = begin;
    aboveEnd = m_runs.size();
  }
  for (std::size_t i = m_parent.size(); i-- > 0;) {
    const std::size_t to = static_cast<std::size_t>(m_parent[i]);
    if (to != i) { // labels only ever point to smaller ones
      vpPatternSpot &a = m_boxes[to];
      const vpPatternSpot &b = m_boxes[i];
      a = {std::min(a.left, b.left),
           std::max(a.right, b.right),
           std::min(a.top, b.top),
           std::max(a.bottom, b.bottom),
           a.area + b.area,
           0.,
           0.};
    }
  }
  for (std::size_t i = 0; i < m_parent.size(); ++i) {
    const vpPatternSpot &box = m_boxes[i];
    if (m_parent[i] != static_cast<int>(i) || box.area < minArea || box.left == 0 || box.top == 0 ||
        box.right == m_width - 1 || box.bottom == m_height - 1) {
      continue;
    }
    if (m_spots.size() == m_maxSpots) {
      return false;
    }
    m_spots.push_back(box);
  }
  return true;
}

END_VISP_NAMESPACE
