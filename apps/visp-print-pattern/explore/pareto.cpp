/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "pareto.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace printExplore
{
bool dominates(const Costs &a, const Costs &b)
{
  bool better = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) {
      return false;
    }
    better = better || a[i] < b[i];
  }
  return better;
}

std::vector<std::size_t> paretoFront(const std::vector<Costs> &points)
{
  // In lexicographic order only earlier points can dominate a point, and by transitivity those of the front suffice.
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const bool beaten =
        std::any_of(front.begin(), front.end(), [&](std::size_t other) { return dominates(points[other], points[i]); });
    if (!beaten) {
      front.push_back(i);
    }
  }
  std::sort(front.begin(), front.end());
  return front;
}

std::size_t compromise(const std::vector<Costs> &points)
{
  Costs least = points.front(), most = points.front();
  for (const Costs &point : points) {
    for (std::size_t i = 0; i < point.size(); ++i) {
      least[i] = std::min(least[i], point[i]);
      most[i] = std::max(most[i], point[i]);
    }
  }
  const auto distance = [&](const Costs &point) {
    double sum = 0.;
    for (std::size_t i = 0; i < point.size(); ++i) {
      const double range = most[i] - least[i];
      sum += range > 0. ? std::pow((point[i] - least[i]) / range, 2) : 0.;
    }
    return sum;
  };
  const auto best = std::min_element(points.begin(), points.end(),
                                     [&](const Costs &a, const Costs &b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(best - points.begin());
}
} // namespace printExplore
