/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpJointPath.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

double vpJointPath::length() const noexcept
{
  double sum = 0.;
  for (std::size_t i = 1; i < points.size(); ++i) {
    sum += (points[i] - points[i - 1]).norm();
  }
  return sum;
}

vpJointVector vpJointPath::at(double s) const noexcept
{
  if (points.empty()) {
    return {};
  }
  double left = std::min(1., std::max(0., s)) * length();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double way = (points[i] - points[i - 1]).norm();
    if (left <= way && way > 0.) {
      return points[i - 1] + left / way * (points[i] - points[i - 1]);
    }
    left -= way;
  }
  return points.back();
}

END_VISP_NAMESPACE
