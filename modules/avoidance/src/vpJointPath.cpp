/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A path of joints, and the parameters of its planner, which exist without OMPL too.
#include <visp3/avoidance/vpJointPath.h>

#include "vpFieldCheck.h"

#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/core/vpException.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the path planner");
} // namespace

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

const std::vector<std::string> &vpPathPlanner::names()
{
  static const std::vector<std::string> all{"RRT", "RRTConnect", "RRTstar", "PRM", "BITstar", "KPIECE"};
  return all;
}

void vpPathPlannerSpec::validate() const
{
  const std::vector<std::string> &names = vpPathPlanner::names();
  if (std::find(names.begin(), names.end(), planner) == names.end()) {
    std::string known;
    for (const std::string &name : names) {
      known += (known.empty() ? "" : ", ") + name;
    }
    throw vpException(vpException::badValue, "unknown path planner '%s', known are %s", planner.c_str(), known.c_str());
  }
  fields.notNegative("margin", margin);
  fields.positive("step", step);
  fields.positive("timeLimit", timeLimit);
  fields.notNegative("range", range);
  fields.notNegative("shortenTime", shortenTime);
  fields.in("seed", seed, {1});
}

END_VISP_NAMESPACE
