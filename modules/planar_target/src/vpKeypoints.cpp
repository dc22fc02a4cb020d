/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypoints.h"

#include <visp3/core/vpException.h>

#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <numeric>

// Counting bits is one instruction on every x86 of the last fifteen years, and one for eight words on newer ones, but
// not on the baseline that compilers build for. The version is selected at run time. OpenCV's own distances take ten
// times as long.
#if defined(__x86_64__) && defined(__GNUC__)
#define VISP_DIRECT_POPCOUNT_VERSIONS
#define VISP_DIRECT_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define VISP_DIRECT_ALWAYS_INLINE inline
#endif

BEGIN_VISP_NAMESPACE

namespace
{
// The default of 20 loses corners of a blurred or dim target; 15 keeps them, within the bound on their number.
constexpr int fastThreshold = 15;

constexpr float loweRatio = 0.8f; // nearest over second nearest, of a match

class OpenCvExtractor : public vpKeypointExtractor
{
public:
  OpenCvExtractor(cv::Ptr<cv::Feature2D> feature, unsigned int maxKeypoints)
    : m_feature(std::move(feature)), m_maxKeypoints(maxKeypoints)
  {}

  void extract(const cv::Mat &image, vpKeypointSet &keypoints) override
  {
    // Detection and description together: AKAZE, KAZE and SIFT would build their scale space twice.
    m_feature->detectAndCompute(image, cv::noArray(), m_found, m_descriptors);
    m_order.resize(m_found.size());
    std::iota(m_order.begin(), m_order.end(), 0);
    std::stable_sort(m_order.begin(), m_order.end(), [this](int a, int b) {
      return m_found[static_cast<std::size_t>(a)].response > m_found[static_cast<std::size_t>(b)].response;
    });
    m_order.resize(std::min<std::size_t>(m_order.size(), m_maxKeypoints));
    keypoints.points.clear();
    keypoints.descriptors.create(static_cast<int>(m_order.size()), m_descriptors.cols, m_descriptors.type());
    for (std::size_t i = 0; i < m_order.size(); ++i) {
      keypoints.points.push_back(m_found[static_cast<std::size_t>(m_order[i])].pt);
      m_descriptors.row(m_order[i]).copyTo(keypoints.descriptors.row(static_cast<int>(i)));
    }
    keypoints.pack();
  }

private:
  cv::Ptr<cv::Feature2D> m_feature;
  unsigned int m_maxKeypoints;
  std::vector<cv::KeyPoint> m_found;
  std::vector<int> m_order; // indices of m_found, by strength
  cv::Mat m_descriptors;
};

// A distance and its index in one number: the smallest is the nearest and, of equals, the first.
constexpr int placeBits = 21; // for two million keypoints
constexpr int far = std::numeric_limits<int>::max();
int distanceOf(int key) { return key >> placeBits; }
int placeOf(int key) { return key & ((1 << placeBits) - 1); }

struct Nearest {
  int best = far, second = far; // keys
};

// One descriptor against all \e n others: keys by column, the two smallest of them, and the smallest of each column so
// far.
VISP_DIRECT_ALWAYS_INLINE Nearest compareRow(const std::uint64_t *from, const std::uint64_t *to, std::size_t n,
                                             std::size_t words, int row, int *__restrict keys, int *__restrict columns)
{
  std::fill_n(keys, n, 0);
  for (std::size_t k = 0; k < words; k += 4) {
    const std::uint64_t f0 = from[k], f1 = from[k + 1], f2 = from[k + 2], f3 = from[k + 3];
    const std::uint64_t *t0 = to + k * n, *t1 = t0 + n, *t2 = t1 + n, *t3 = t2 + n;
    for (std::size_t j = 0; j < n; ++j) {
      keys[j] += __builtin_popcountll(f0 ^ t0[j]) + __builtin_popcountll(f1 ^ t1[j]) +
                 __builtin_popcountll(f2 ^ t2[j]) + __builtin_popcountll(f3 ^ t3[j]);
    }
  }
  Nearest nearest;
  for (std::size_t j = 0; j < n; ++j) {
    const int d = keys[j] << placeBits;
    columns[j] = std::min(columns[j], d + row);
    keys[j] = d + static_cast<int>(j);
    nearest.best = std::min(nearest.best, keys[j]);
  }
  for (std::size_t j = 0; j < n; ++j) {
    nearest.second = std::min(nearest.second, keys[j] == nearest.best ? far : keys[j]);
  }
  return nearest;
}

using CompareRow = Nearest (*)(const std::uint64_t *, const std::uint64_t *, std::size_t, std::size_t, int, int *,
                               int *);

Nearest compareRowAnywhere(const std::uint64_t *from, const std::uint64_t *to, std::size_t n, std::size_t words,
                           int row, int *keys, int *columns)
{
  return compareRow(from, to, n, words, row, keys, columns);
}

#ifdef VISP_DIRECT_POPCOUNT_VERSIONS
__attribute__((target("popcnt,sse4.1"))) Nearest compareRowPopcount(const std::uint64_t *from, const std::uint64_t *to,
                                                                    std::size_t n, std::size_t words, int row,
                                                                    int *keys, int *columns)
{
  return compareRow(from, to, n, words, row, keys, columns);
}

__attribute__((target("popcnt,avx512f,avx512vl,avx512bw,avx512vpopcntdq"))) Nearest
compareRowAvx512(const std::uint64_t *from, const std::uint64_t *to, std::size_t n, std::size_t words, int row,
                 int *keys, int *columns)
{
  return compareRow(from, to, n, words, row, keys, columns);
}
#endif

CompareRow bestVersion()
{
#ifdef VISP_DIRECT_POPCOUNT_VERSIONS
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vpopcntdq")) {
    return compareRowAvx512;
  }
  if (__builtin_cpu_supports("popcnt") && __builtin_cpu_supports("sse4.1")) {
    return compareRowPopcount;
  }
#endif
  return compareRowAnywhere;
}

// Finds the two nearest of each row, and returns the nearest row of each column.
template <class Take>
std::vector<int> compareAll(const vpKeypointSet &reference, const vpKeypointSet &current, const Take &take)
{
  static const CompareRow compare = bestVersion();
  const std::size_t words = current.words(), rows = reference.points.size(), cols = current.points.size();
  std::vector<int> keys(cols), columns(cols, far);
  std::vector<std::uint64_t> from(words);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < words; ++k) {
      from[k] = reference.packed[k * rows + i];
    }
    take(static_cast<int>(i),
         compare(from.data(), current.packed.data(), cols, words, static_cast<int>(i), keys.data(), columns.data()));
  }
  return columns;
}

std::vector<std::pair<int, int>> matchBinary(const vpKeypointSet &reference, const vpKeypointSet &current)
{
  std::vector<std::pair<int, int>> candidates, mutual;
  const std::vector<int> columns = compareAll(reference, current, [&](int row, const Nearest &nearest) {
    if (static_cast<float>(distanceOf(nearest.best)) < loweRatio * static_cast<float>(distanceOf(nearest.second))) {
      candidates.emplace_back(row, placeOf(nearest.best));
    }
  });
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(mutual),
               [&columns](const std::pair<int, int> &pair) {
                 return placeOf(columns[static_cast<std::size_t>(pair.second)]) == pair.first;
               });
  return mutual;
}

// Processes one row of distances after the other; keeps the two nearest of each row and the nearest of each column.
class MutualMatches
{
public:
  explicit MutualMatches(std::size_t cols) : m_rowOfColumn(cols, -1), m_bestOfColumn(cols, infinity) {}

  void add(int row, const float *distances)
  {
    float best = infinity, second = infinity;
    int nearest = -1;
    for (std::size_t j = 0; j < m_bestOfColumn.size(); ++j) {
      const float d = distances[j];
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
    if (nearest >= 0 && best < loweRatio * second) {
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
  static constexpr float infinity = std::numeric_limits<float>::max();
  std::vector<int> m_rowOfColumn;
  std::vector<float> m_bestOfColumn;
  std::vector<std::pair<int, int>> m_candidates;
};

std::vector<std::pair<int, int>> matchReal(const vpKeypointSet &reference, const vpKeypointSet &current)
{
  cv::Mat distances;
  cv::batchDistance(reference.descriptors, current.descriptors, distances, CV_32F, cv::noArray(), cv::NORM_L2);
  MutualMatches matches(current.points.size());
  for (int i = 0; i < distances.rows; ++i) {
    matches.add(i, distances.ptr<float>(i));
  }
  return matches.matches();
}

// Distance of each descriptor to the nearest other one of its image.
std::vector<float> isolation(const vpKeypointSet &set)
{
  std::vector<float> alone(set.points.size());
  if (!set.packed.empty()) { // the nearest is itself, or its duplicate
    compareAll(set, set, [&alone](int row, const Nearest &nearest) {
      alone[static_cast<std::size_t>(row)] = static_cast<float>(distanceOf(nearest.second));
    });
    return alone;
  }
  cv::Mat distances;
  cv::batchDistance(set.descriptors, set.descriptors, distances, CV_32F, cv::noArray(), cv::NORM_L2);
  for (int i = 0; i < distances.rows; ++i) {
    distances.at<float>(i, i) = std::numeric_limits<float>::max();
    double least = 0.;
    cv::minMaxLoc(distances.row(i), &least);
    alone[static_cast<std::size_t>(i)] = static_cast<float>(least);
  }
  return alone;
}
} // namespace

std::size_t vpKeypointSet::words() const
{
  return (static_cast<std::size_t>(descriptors.cols) * descriptors.elemSize() + 31) / 32 * 4;
}

void vpKeypointSet::pack()
{
  packed.clear();
  if (descriptors.empty() || descriptors.depth() != CV_8U) {
    return;
  }
  const std::size_t n = static_cast<std::size_t>(descriptors.rows);
  std::vector<std::uint64_t> row(words(), 0); // padded with zeros: AKAZE has 61 bytes
  packed.resize(n * row.size());
  for (std::size_t i = 0; i < n; ++i) {
    std::memcpy(row.data(), descriptors.ptr(static_cast<int>(i)), static_cast<std::size_t>(descriptors.cols));
    for (std::size_t k = 0; k < row.size(); ++k) {
      packed[k * n + i] = row[k];
    }
  }
}

std::unique_ptr<vpKeypointExtractor> makeKeypointExtractor(vpKeypointType type, const vpPlanarTargetSpec &spec)
{
  const unsigned int maxKeypoints = spec.maxKeypoints;
  cv::Ptr<cv::Feature2D> feature;
  switch (type) {
  case vpKeypointType::ORB:
    feature =
        cv::ORB::create(static_cast<int>(maxKeypoints), 1.2f, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31, fastThreshold);
    break;
  case vpKeypointType::SIFT:
    feature = cv::SIFT::create(static_cast<int>(maxKeypoints));
    break;
  case vpKeypointType::AKAZE:
    feature = cv::AKAZE::create();
    break;
  case vpKeypointType::KAZE:
    feature = cv::KAZE::create();
    break;
  case vpKeypointType::BRISK:
    feature = cv::BRISK::create();
    break;
  case vpKeypointType::SURF:
    return makeSurfExtractor(spec);
  }
  if (!feature) {
    throw vpException(vpException::badValue, "keypoint type %d is not known", static_cast<int>(type));
  }
  return std::make_unique<OpenCvExtractor>(feature, maxKeypoints);
}

std::vector<std::pair<int, int>> matchKeypoints(const vpKeypointSet &reference, const vpKeypointSet &current)
{
  if (reference.points.empty() || current.points.empty()) {
    return {};
  }
  return (reference.packed.empty() ? matchReal : matchBinary)(reference, current);
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
