/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpAvoidanceMethods.h>

#include "vpPlannerMethods.h"

#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>
#include <visp3/avoidance/vpPotentialFieldAvoidance.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <array>

BEGIN_VISP_NAMESPACE

namespace
{
struct Known {
  const char *name, *sentence;
};
constexpr std::array<Known, 6> known{
    {{"potential", "is pushed aside in the image, as the thesis prints it (8.1)-(8.2): touches and overshoots"},
     {"potential-corrected", "is pushed away from the obstacle, within bounds of speed and joints"},
     {"dtg", "takes another final position beside the obstacle until the way to the goal is free"},
     {"dtg-via", "takes via positions round the obstacle, the shortest way first"},
     {"planner", "brakes, and plans anew when it stands"},
     {"planner-dtg", "plans anew from the moving state, and brakes only if there is no way"}}};
} // namespace

const std::vector<std::string> &vpAvoidanceMethodNames()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Known &method : known) {
      all.emplace_back(method.name);
    }
    return all;
  }();
  return names;
}

const char *vpAvoidanceMethodMessage(const std::string &name) noexcept
{
  const auto found = std::find_if(known.begin(), known.end(), [&name](const Known &m) { return name == m.name; });
  return found == known.end() ? "" : found->sentence;
}

std::unique_ptr<vpAvoidanceMethod> makeAvoidanceMethod(const std::string &name, const vpCollisionScene &scene,
                                                       const vpAvoidanceMethodSpec &spec)
{
  if (name == "planner" || name == "planner-dtg") {
    return makePlannedMotion(scene, name == "planner-dtg", spec);
  }
  if (name == "potential" || name == "potential-corrected") {
    vpPotentialFieldAvoidanceSpec full;
    full.common = spec;
    full.form = name == "potential" ? vpFieldForm::Thesis : vpFieldForm::Corrected;
    return std::make_unique<vpPotentialFieldAvoidance>(scene, full);
  }
  if (name == "dtg" || name == "dtg-via") {
    vpDirectTrajectoryAvoidanceSpec full;
    full.common = spec;
    full.detour = name == "dtg" ? vpDetourKind::PointToPoint : vpDetourKind::Via;
    return std::make_unique<vpDirectTrajectoryAvoidance>(scene, full);
  }
  std::string names;
  for (const std::string &other : vpAvoidanceMethodNames()) {
    names += (names.empty() ? "" : ", ") + other;
  }
  throw vpException(vpException::badValue, "unknown avoidance method '%s', known are %s", name.c_str(), names.c_str());
}

END_VISP_NAMESPACE
