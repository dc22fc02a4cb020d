/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpAvoidanceMethods.h>

#include "vpPlannerMethods.h"

#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>
#include <visp3/avoidance/vpPotentialFieldAvoidance.h>
#include <visp3/core/vpException.h>

BEGIN_VISP_NAMESPACE

const std::vector<std::string> &avoidanceMethodNames()
{
  static const std::vector<std::string> names{"potential", "potential-corrected", "dtg", "dtg-via",
                                              "planner",   "planner-dtg"};
  return names;
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
    full.detour = name == "dtg" ? vpDetourKind::Final : vpDetourKind::Via;
    return std::make_unique<vpDirectTrajectoryAvoidance>(scene, full);
  }
  std::string known;
  for (const std::string &other : avoidanceMethodNames()) {
    known += (known.empty() ? "" : ", ") + other;
  }
  throw vpException(vpException::badValue, "unknown avoidance method '%s', known are %s", name.c_str(), known.c_str());
}

END_VISP_NAMESPACE
