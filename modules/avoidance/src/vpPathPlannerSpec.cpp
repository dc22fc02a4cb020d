/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
void requireGood(const char *field, double value, bool good, const char *range)
{
  if (!good || !std::isfinite(value)) {
    throw vpException(vpException::badValue, "%s of the path planner is %g, must be %s and finite", field, value,
                      range);
  }
}
} // namespace

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
  requireGood("margin", margin, margin >= 0., ">= 0");
  requireGood("step", step, step > 0., "> 0");
  requireGood("timeLimit", timeLimit, timeLimit > 0., "> 0");
  requireGood("range", range, range >= 0., ">= 0");
  requireGood("shortenTime", shortenTime, shortenTime >= 0., ">= 0");
  requireGood("seed", seed, seed >= 1, ">= 1");
}

END_VISP_NAMESPACE
