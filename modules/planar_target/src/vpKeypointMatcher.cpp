/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypointMatcher.h"

#include <cstdint>
#include <cstring>
#include <limits>

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

// Rows of bytes as rows of 64-bit words, filled up with zeros (AKAZE has 61 bytes).
std::vector<std::uint64_t> toWords(const cv::Mat &descriptors, std::size_t words)
{
  std::vector<std::uint64_t> packed(static_cast<std::size_t>(descriptors.rows) * words, 0);
  for (int i = 0; i < descriptors.rows; ++i) {
    std::memcpy(&packed[static_cast<std::size_t>(i) * words], descriptors.ptr(i),
                static_cast<std::size_t>(descriptors.cols));
  }
  return packed;
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

std::vector<std::pair<int, int>> matchBinary(const cv::Mat &reference, const cv::Mat &current, float ratio)
{
  const std::size_t words = (static_cast<std::size_t>(current.cols) + 7) / 8,
                    cols = static_cast<std::size_t>(current.rows);
  const std::vector<std::uint64_t> from = toWords(reference, words), to = toWords(current, words);
  std::vector<int> distances(cols);
  MutualMatches<int> matches(cols, ratio);
  for (int i = 0; i < reference.rows; ++i) {
    hammingDistances(&from[static_cast<std::size_t>(i) * words], to.data(), cols, words, distances.data());
    matches.add(i, distances.data());
  }
  return matches.matches();
}

std::vector<std::pair<int, int>> matchReal(const cv::Mat &reference, const cv::Mat &current, float ratio)
{
  cv::Mat distances;
  cv::batchDistance(reference, current, distances, CV_32F, cv::noArray(), cv::NORM_L2);
  MutualMatches<float> matches(static_cast<std::size_t>(current.rows), ratio);
  for (int i = 0; i < distances.rows; ++i) {
    matches.add(i, distances.ptr<float>(i));
  }
  return matches.matches();
}
} // namespace

std::vector<std::pair<int, int>> matchKeypoints(const vpKeypointSet &reference, const vpKeypointSet &current,
                                                float ratio)
{
  if (reference.points.empty() || current.points.empty()) {
    return {};
  }
  const bool binary = reference.descriptors.depth() == CV_8U;
  return (binary ? matchBinary : matchReal)(reference.descriptors, current.descriptors, ratio);
}

END_VISP_NAMESPACE
