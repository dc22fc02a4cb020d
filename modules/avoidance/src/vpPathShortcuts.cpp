/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPathShortcuts.h"

#include <algorithm>
#include <cmath>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int mostMisses = 30; // shortcuts in a row that gain nothing
constexpr int mostTries = 300; // shortcuts of a path
constexpr double gain = 1e-3;  // of the length: a shortcut that gains less counts as none

// A place on a path: between point and the next.
struct Place {
  std::size_t point;
  vpJointVector q;
};

Place placeOf(const vpJointPath &path, double way)
{
  std::size_t i = 0;
  double length = (path.points[1] - path.points[0]).norm();
  while (i + 2 < path.points.size() && way > length) {
    way -= length;
    ++i;
    length = (path.points[i + 1] - path.points[i]).norm();
  }
  const double share = length > 0. ? std::min(1., way / length) : 0.;
  return {i, path.points[i] + share * (path.points[i + 1] - path.points[i])};
}
} // namespace

bool vpPathShortcuts::isTimeLeft() const { return std::chrono::steady_clock::now() < m_end; }

bool vpPathShortcuts::isFree(const vpJointVector &from, const vpJointVector &to)
{
  ++m_motions;
  return m_check->isFree(from, to);
}

// From each point straight to the last one that is free from there.
void vpPathShortcuts::leaveOutPoints(vpJointPath &path)
{
  std::vector<vpJointVector> &points = path.points;
  for (std::size_t i = 0; i + 2 < points.size(); ++i) {
    std::size_t k = points.size() - 1;
    while (k > i + 1 && isTimeLeft() && !isFree(points[i], points[k])) {
      --k;
    }
    if (!isTimeLeft()) {
      return;
    }
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(i) + 1, points.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

// Joins two random places; returns by how much the path is shorter, a share of its length.
double vpPathShortcuts::join(vpJointPath &path)
{
  const double length = path.length();
  const double one = m_random->uniform(0., length), two = m_random->uniform(0., length);
  const Place from = placeOf(path, std::min(one, two)), to = placeOf(path, std::max(one, two));
  const double saved = std::fabs(two - one) - (to.q - from.q).norm();
  if (from.point == to.point || !(saved > gain * length) || !isFree(from.q, to.q)) {
    return 0.;
  }
  const auto begin = path.points.begin() + static_cast<std::ptrdiff_t>(from.point) + 1;
  const auto end = path.points.begin() + static_cast<std::ptrdiff_t>(to.point) + 1;
  path.points.insert(path.points.erase(begin, end), {from.q, to.q});
  return saved / length;
}

void vpPathShortcuts::apply(vpJointPath &path, double time)
{
  m_end = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                 std::chrono::duration<double>(std::min(time, 1e6)));
  leaveOutPoints(path);
  int misses = 0;
  for (int k = 0; k < mostTries && misses < mostMisses && path.points.size() > 2 && isTimeLeft(); ++k) {
    misses = join(path) > 0. ? 0 : misses + 1;
  }
  leaveOutPoints(path);
}

END_VISP_NAMESPACE
