/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPatternSpot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int block = 64; // pixels

// Bit i is set when pixel i is above the threshold, 0..255.
[[maybe_unused]] std::uint64_t blockAboveAnywhere(const unsigned char *pixels, int threshold)
{
  std::uint64_t bits = 0;
  for (int i = 0; i < block; ++i) {
    bits |= static_cast<std::uint64_t>(pixels[i] > threshold) << i;
  }
  return bits;
}

#if defined(__SSE2__)
std::uint64_t blockAbove(const unsigned char *pixels, int threshold)
{
  const __m128i limit = _mm_set1_epi8(static_cast<char>(threshold));
  std::uint64_t bits = 0;
  for (int i = 0; i < block; i += 16) {
    const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i *>(pixels + i));
    const __m128i notAbove = _mm_cmpeq_epi8(_mm_max_epu8(v, limit), limit);
    bits |= static_cast<std::uint64_t>(_mm_movemask_epi8(notAbove)) << i;
  }
  return ~bits;
}
#else
std::uint64_t blockAbove(const unsigned char *pixels, int threshold) { return blockAboveAnywhere(pixels, threshold); }
#endif

// Number of the lowest bit that is set; there must be one.
int firstBit(std::uint64_t bits)
{
#if defined(__GNUC__)
  return __builtin_ctzll(bits);
#else
  int n = 0;
  for (; (bits & 1) == 0; bits >>= 1) {
    ++n;
  }
  return n;
#endif
}

// The image along one axis: along(position, line) for either axis, with the border repeated.
struct View {
  const vpImage<unsigned char> &image;
  bool vertical;
  int length() const { return static_cast<int>(vertical ? image.getHeight() : image.getWidth()); }
  int lines() const { return static_cast<int>(vertical ? image.getWidth() : image.getHeight()); }
  int at(int position, int line) const
  {
    const auto p = static_cast<unsigned int>(std::clamp(position, 0, length() - 1));
    const auto l = static_cast<unsigned int>(std::clamp(line, 0, lines() - 1));
    return vertical ? image[p][l] : image[l][p];
  }
};

// Crossing of the level between two neighbouring pixels with the values a and b, in steps from a; or NaN.
double crossing(double a, double b) { return a * b > 0. || a == b ? NAN : a / (a - b); }

// Mean of the midpoints between both edges over the middle three quarters of the lines. \e along and \e across are the
// memory steps, \e level is in these directions; the box does not touch the border of the image.
double middle(const unsigned char *pixels, std::ptrdiff_t along, std::ptrdiff_t across, int low, int high,
              int firstLine, int lastLine, const vpEdgeLevel &level)
{
  const int skip = (lastLine - firstLine + 1) / 8, step = std::max(1, (lastLine - firstLine + 1) / 16);
  const int most = std::min(3, high - low + 2);
  double sum = 0.;
  int count = 0;
  for (int line = firstLine + skip; line <= lastLine - skip; line += step) {
    const unsigned char *from = pixels + line * across;
    const double levelOfLine = level.value + level.slopeY * line;
    const auto value = [&](int position) { return from[position * along] - (levelOfLine + level.slopeX * position); };
    // The box may be a pixel wider than this line, at rounded corners or when the cell is turned.
    double edges[2] = {NAN, NAN};
    for (int k = 0; k < most && std::isnan(edges[0]); ++k) {
      edges[0] = low - 1 + k + crossing(value(low - 1 + k), value(low + k));
    }
    for (int k = 0; k < most && std::isnan(edges[1]); ++k) {
      edges[1] = high + 1 - k - crossing(value(high + 1 - k), value(high - k));
    }
    if (!std::isnan(edges[0]) && !std::isnan(edges[1])) {
      sum += 0.5 * (edges[0] + edges[1]);
      ++count;
    }
  }
  return count > 0 ? sum / count : NAN;
}

double gradient(const View &view, int position, int line, vpPatternDerivative derivative)
{
  const auto difference = [&](int l) { return view.at(position + 1, l) - view.at(position - 1, l); };
  switch (derivative) {
  case vpPatternDerivative::Roberts:
    return std::abs(view.at(position + 1, line) - view.at(position, line));
  case vpPatternDerivative::Prewitt:
    return std::abs(difference(line - 1) + difference(line) + difference(line + 1));
  case vpPatternDerivative::Sobel:
    return std::abs(difference(line - 1) + 2 * difference(line) + difference(line + 1));
  case vpPatternDerivative::Symmetric:
    break;
  }
  return std::abs(difference(line));
}

// Steepest position near an edge: (7.13) and (7.14), mean over three lines. Unguarded, the parabola may diverge.
double steepest(const View &view, int edge, int line, vpPatternDerivative derivative, bool guarded)
{
  double sum = 0.;
  int count = 0;
  for (int l = line - 1; l <= line + 1; ++l) {
    int best = edge;
    for (int p = edge - 2; p <= edge + 2; ++p) {
      best = gradient(view, p, l, derivative) > gradient(view, best, l, derivative) ? p : best;
    }
    const double a = gradient(view, best - 1, l, derivative), b = gradient(view, best, l, derivative);
    const double c = gradient(view, best + 1, l, derivative), curvature = a - 2. * b + c;
    if (curvature == 0. || (guarded && (curvature > 0. || b < a || b < c))) {
      continue;
    }
    sum += best + (a - c) / (2. * curvature);
    ++count;
  }
  // The difference of two neighbours is located between them.
  return count == 0 ? NAN : sum / count + (derivative == vpPatternDerivative::Roberts ? 0.5 : 0.);
}

int roundToInt(double value) { return static_cast<int>(std::lround(value)); }
} // namespace

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

// Runs of one row. 64 pixels at a time become 64 bits; runs end where a bit differs from the previous one.
bool vpRunLabels::scanRow(const unsigned char *row, int threshold, bool bright)
{
  const std::uint64_t other = bright ? 0 : ~std::uint64_t(0);
  std::uint64_t last = 0; // 1: the pixel before belongs to a run
  int begin = 0;
  for (int x = 0; x < m_width; x += block) {
    const int left = m_width - x;
    std::uint64_t bits = 0;
    if (left >= block) {
      bits = blockAbove(row + x, threshold) ^ other;
    }
    else if (m_width >= block) { // the last 64 of the row, without those already processed
      bits = (blockAbove(row + m_width - block, threshold) ^ other) >> (block - left);
    }
    else {
      for (int i = 0; i < left; ++i) {
        bits |= static_cast<std::uint64_t>((row[x + i] > threshold) == bright) << i;
      }
    }
    for (std::uint64_t ends = bits ^ (bits << 1 | last); ends != 0; ends &= ends - 1) {
      const int at = x + firstBit(ends);
      if (at >= m_width) { // a run up to the border of the image, which ends below
        break;
      }
      last ^= 1;
      if (last != 0) {
        begin = at;
      }
      else if (m_runs.size() == m_runs.capacity()) {
        return false;
      }
      else {
        m_runs.push_back({begin, at, -1});
      }
    }
  }
  if (last != 0) { // up to the border of the image
    if (m_runs.size() == m_runs.capacity()) {
      return false;
    }
    m_runs.push_back({begin, m_width, -1});
  }
  return true;
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

bool vpHalfMaximumCentre(const vpImage<unsigned char> &image, const vpEdgeLevel &level, vpPatternSpot &spot)
{
  const std::ptrdiff_t row = image.getWidth();
  spot.x = middle(image.bitmap, 1, row, spot.left, spot.right, spot.top, spot.bottom, level);
  spot.y = middle(image.bitmap, row, 1, spot.top, spot.bottom, spot.left, spot.right,
                  {level.value, level.slopeY, level.slopeX});
  return std::isfinite(spot.x) && std::isfinite(spot.y);
}

bool vpThesisCentre(const vpImage<unsigned char> &image, vpPatternDerivative derivative, vpPatternSpot &spot)
{
  const View columns{image, true};
  const double x1 = spot.left + 0.2 * spot.width(), x2 = spot.left + 0.8 * spot.width();
  const double leftUp = steepest(columns, spot.top, roundToInt(x1), derivative, false);
  const double leftDown = steepest(columns, spot.bottom, roundToInt(x1), derivative, false);
  const double rightUp = steepest(columns, spot.top, roundToInt(x2), derivative, false);
  const double rightDown = steepest(columns, spot.bottom, roundToInt(x2), derivative, false);
  const double a1 = (rightDown - leftUp) / (x2 - x1), b1 = leftUp - a1 * x1;
  const double a2 = (rightUp - leftDown) / (x2 - x1), b2 = leftDown - a2 * x1;
  spot.x = (b2 - b1) / (a1 - a2);
  spot.y = spot.x * a2 + b2;
  return std::isfinite(spot.x) && std::isfinite(spot.y);
}

bool vpThesisCentreFixed(const vpImage<unsigned char> &image, vpPatternDerivative derivative, vpPatternSpot &spot)
{
  const View columns{image, true}, rows{image, false};
  spot.x = spot.y = 0.;
  for (const double part : {0.2, 0.8}) {
    const int column = roundToInt(spot.left + part * (spot.width() - 1));
    const int row = roundToInt(spot.top + part * (spot.height() - 1));
    spot.y += 0.25 * (steepest(columns, spot.top, column, derivative, true) +
                      steepest(columns, spot.bottom, column, derivative, true));
    spot.x +=
        0.25 * (steepest(rows, spot.left, row, derivative, true) + steepest(rows, spot.right, row, derivative, true));
  }
  return std::isfinite(spot.x) && std::isfinite(spot.y);
}

END_VISP_NAMESPACE
