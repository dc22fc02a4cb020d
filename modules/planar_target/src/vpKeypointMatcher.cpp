/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypointMatcher.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

// Counting bits is one instruction on every x86 of the last fifteen years, but not of the one that compilers build for.
// The program picks the version at run time. OpenCV's own distances take four times as long, for the tracing of each call.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define VISP_DIRECT_POPCOUNT_CLONES __attribute__((target_clones("popcnt", "default")))
#else
#define VISP_DIRECT_POPCOUNT_CLONES
#endif

BEGIN_VISP_NAMESPACE

namespace
{
// Distances from one binary descriptor to rows of others, all of \e words 64-bit words.
VISP_DIRECT_POPCOUNT_CLONES void hammingDistances(const std::uint64_t *from, const std::uint64_t *to, std::size_t rows,
                                                  std::size_t words, int *distances)
{
  for (std::size_t j = 0; j < rows; ++j, to += words) {
    int d = 0;
    for (std::size_t k = 0; k < words; ++k) {
      d += __builtin_popcountll(from[k] ^ to[k]);
    }
    distances[j] = d;
  }
}

// Feeds on one row of distances after the other; keeps the two nearest of each row and the nearest of each column.
template <typename T> class MutualMatches
{
public:
  MutualMatches(std::size_t cols, float ratio) : m_ratio(ratio), m_rowOfColumn(cols, -1), m_bestOfColumn(cols, infinity)
  {}

  void add(int row, const T *distances)
  {
    T best = infinity, second = infinity;
    int nearest = -1;
    for (std::size_t j = 0; j < m_bestOfColumn.size(); ++j) {
      const T d = distances[j];
      if (d < best) {
        second = best;
        best = d;
        nearest = static_cast<int>(j);
      }
      else if (d < second) {
        second = d;
      }
      if (d < m_bestOfColumn[j]) {
        m_bestOfColumn[j] = d;
        m_rowOfColumn[j] = row;
      }
    }
    if (nearest >= 0 && static_cast<float>(best) < m_ratio * static_cast<float>(second)) {
      m_candidates.emplace_back(row, nearest);
    }
  }

  [[nodiscard]] std::vector<std::pair<int, int>> matches() const
  {
    std::vector<std::pair<int, int>> mutual;
    for (const auto &pair : m_candidates) {
      if (m_rowOfColumn[static_cast<std::size_t>(pair.second)] == pair.first) {
        mutual.push_back(pair);
      }
    }
    return mutual;
  }

private:
  static constexpr T infinity = std::numeric_limits<T>::max();
  float m_ratio;
  std::vector<int> m_rowOfColumn;
  std::vector<T> m_bestOfColumn;
  std::vector<std::pair<int, int>> m_candidates;
};

// Distances of each row of \e from to all rows of \e to, one row after the other.
template <class Take> void forEachRow(const vpKeypointSet &from, const vpKeypointSet &to, const Take &take)
{
  const std::size_t words = to.words(), cols = to.points.size();
  std::vector<int> distances(cols);
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    hammingDistances(&from.packed[i * words], to.packed.data(), cols, words, distances.data());
    take(static_cast<int>(i), distances);
  }
}

std::vector<std::pair<int, int>> matchBinary(const vpKeypointSet &reference, const vpKeypointSet &current, float ratio)
{
  MutualMatches<int> matches(current.points.size(), ratio);
  forEachRow(reference, current,
             [&matches](int row, const std::vector<int> &distances) { matches.add(row, distances.data()); });
  return matches.matches();
}

std::vector<std::pair<int, int>> matchReal(const vpKeypointSet &reference, const vpKeypointSet &current, float ratio)
{
  cv::Mat distances;
  cv::batchDistance(reference.descriptors, current.descriptors, distances, CV_32F, cv::noArray(), cv::NORM_L2);
  MutualMatches<float> matches(current.points.size(), ratio);
  for (int i = 0; i < distances.rows; ++i) {
    matches.add(i, distances.ptr<float>(i));
  }
  return matches.matches();
}

// How far each descriptor is from the nearest other one of its image.
std::vector<float> isolation(const vpKeypointSet &set)
{
  std::vector<float> nearest(set.points.size(), std::numeric_limits<float>::max());
  const auto take = [&nearest](int row, const auto &distances) {
    for (std::size_t j = 0; j < nearest.size(); ++j) {
      if (j != static_cast<std::size_t>(row)) {
        nearest[j] = std::min(nearest[j], static_cast<float>(distances[j]));
      }
    }
  };
  if (!set.packed.empty()) {
    forEachRow(set, set, take);
    return nearest;
  }
  cv::Mat distances;
  cv::batchDistance(set.descriptors, set.descriptors, distances, CV_32F, cv::noArray(), cv::NORM_L2);
  for (int i = 0; i < distances.rows; ++i) {
    take(i, distances.ptr<float>(i));
  }
  return nearest;
}
} // namespace

std::vector<std::pair<int, int>> matchKeypoints(const vpKeypointSet &reference, const vpKeypointSet &current,
                                                float ratio)
{
  if (reference.points.empty() || current.points.empty()) {
    return {};
  }
  return (reference.packed.empty() ? matchReal : matchBinary)(reference, current, ratio);
}

vpKeypointSet tellingKeypoints(const vpKeypointSet &set, std::size_t most)
{
  constexpr std::size_t strong = 500; // weaker ones are often not found again
  const std::size_t n = set.points.size();
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  if (n > most) {
    const std::vector<float> alone = isolation(set);
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(most / 2);
    std::stable_sort(first, order.begin() + static_cast<std::ptrdiff_t>(std::min(n, strong)), [&alone](int a, int b) {
      return alone[static_cast<std::size_t>(a)] > alone[static_cast<std::size_t>(b)];
    });
    order.resize(most);
  }
  vpKeypointSet chosen;
  for (const int i : order) {
    chosen.points.push_back(set.points[static_cast<std::size_t>(i)]);
    chosen.descriptors.push_back(set.descriptors.row(i));
  }
  chosen.pack();
  return chosen;
}

END_VISP_NAMESPACE
