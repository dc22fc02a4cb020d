/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypointMatcher.h"

#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
// One pass over the matrix: the two nearest of each row, the nearest of each column.
template <typename T> std::vector<std::pair<int, int> > mutualMatches(const cv::Mat &distances, float ratio)
{
  const T infinity = std::numeric_limits<T>::max();
  std::vector<int> rowOfColumn(static_cast<std::size_t>(distances.cols), -1);
  std::vector<T> bestOfColumn(static_cast<std::size_t>(distances.cols), infinity);
  std::vector<std::pair<int, int> > candidates;
  for (int i = 0; i < distances.rows; ++i) {
    const T *row = distances.ptr<T>(i);
    T best = infinity, second = infinity;
    int nearest = -1;
    for (int j = 0; j < distances.cols; ++j) {
      const T d = row[j];
      if (d < best) {
        second = best;
        best = d;
        nearest = j;
      }
      else if (d < second) {
        second = d;
      }
      if (d < bestOfColumn[static_cast<std::size_t>(j)]) {
        bestOfColumn[static_cast<std::size_t>(j)] = d;
        rowOfColumn[static_cast<std::size_t>(j)] = i;
      }
    }
    if (nearest >= 0 && static_cast<float>(best) < ratio * static_cast<float>(second)) {
      candidates.emplace_back(i, nearest);
    }
  }
  std::vector<std::pair<int, int> > matches;
  for (const auto &pair : candidates) {
    if (rowOfColumn[static_cast<std::size_t>(pair.second)] == pair.first) {
      matches.push_back(pair);
    }
  }
  return matches;
}
} // namespace

std::vector<std::pair<int, int> > matchKeypoints(const vpKeypointSet &reference, const vpKeypointSet &current, float ratio)
{
  if (reference.points.empty() || current.points.empty()) {
    return {};
  }
  const bool binary = reference.descriptors.depth() == CV_8U;
  cv::Mat distances;
  cv::batchDistance(reference.descriptors, current.descriptors, distances, binary ? CV_32S : CV_32F, cv::noArray(),
                    binary ? cv::NORM_HAMMING : cv::NORM_L2);
  return binary ? mutualMatches<int>(distances, ratio) : mutualMatches<float>(distances, ratio);
}

END_VISP_NAMESPACE
