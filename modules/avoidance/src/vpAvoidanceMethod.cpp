/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpAvoidanceMethod.h>

#include "vpFieldCheck.h"
#include "vpPairText.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>
#include <visp3/avoidance/vpPlannedMotion.h>
#include <visp3/avoidance/vpPotentialFieldAvoidance.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <array>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the avoidance method");
// rad/s or m/s: a braking arm slower than this counts as standing.
constexpr double standing = 1e-3;

//! Names and sentences of all methods.
struct Known {
  const char *name, *sentence;
};
constexpr std::array<Known, 6> known{
    {{"potential", "is pushed aside in the image, as the thesis prints it (8.1)-(8.2): touches and overshoots"},
     {"potential-corrected", "is pushed away from the obstacle, within bounds of speed and joints"},
     {"dtg", "takes another final position beside the obstacle until the way to the goal is free"},
     {"dtg-via", "takes via positions round the obstacle, the shortest way first"},
     {"planner", "brakes, and replans at rest"},
     {"planner-dtg", "replans from the moving state, and brakes only if there is no way"}}};
} // namespace

void vpAvoidanceMethodSpec::validate() const
{
  fields.in("period", period, vpFieldRange::positive(1.), "s");
  fields.positive("maxVelocity", maxVelocity, "m/s");
  fields.positive("maxAcceleration", maxAcceleration, "m/s^2");
  fields.notNegative("margin", margin, "m");
  fields.in("seed", seed, {1});
}

bool vpAvoidanceGoal::fits(const vpArmModel &model) const noexcept
{
  constexpr double fastest = 1e3; // m/s
  return (q.size() == 0 || (q.size() == model.size() && (q.cwiseAbs().array() <= vpLargestCoordinate).all())) &&
         (position.cwiseAbs().array() <= vpLargestLength).all() && (velocity.cwiseAbs().array() <= fastest).all();
}

vpAvoidanceGoal vpAvoidanceGoal::at(const vpArmModel &model, const vpJointVector &q)
{
  if (q.size() != model.size() || !q.allFinite()) {
    throw vpException(vpException::badValue, "a goal of %d numbers does not fit arm %s of %d joints, or is not finite",
                      static_cast<int>(q.size()), model.label().c_str(), model.size());
  }
  vpArmData data;
  vpArmKinematics::forward(model, q, data);
  vpAvoidanceGoal goal;
  goal.q = q;
  goal.position = data.tool.p;
  return goal;
}

bool vpIsWorking(const vpAvoidanceOutput &output) noexcept
{
  switch (output.status) {
  case vpAvoidanceStatus::Moving:
  case vpAvoidanceStatus::Detouring:
  case vpAvoidanceStatus::Slowed:
  case vpAvoidanceStatus::Waiting:
  case vpAvoidanceStatus::Unsafe:
    return true;
  case vpAvoidanceStatus::Arrived:
    return false;
  default: // brakes; a NaN velocity ends the loop
    return output.velocity.size() > 0 && output.velocity.allFinite() &&
           output.velocity.cwiseAbs().maxCoeff() > standing;
  }
}

const char *vpToString(vpAvoidanceStatus status)
{
  switch (status) {
  case vpAvoidanceStatus::Moving:
    return "Moving";
  case vpAvoidanceStatus::Detouring:
    return "Detouring";
  case vpAvoidanceStatus::Slowed:
    return "Slowed";
  case vpAvoidanceStatus::Waiting:
    return "Waiting";
  case vpAvoidanceStatus::Arrived:
    return "Arrived";
  case vpAvoidanceStatus::GoalInCollision:
    return "GoalInCollision";
  case vpAvoidanceStatus::StartInCollision:
    return "StartInCollision";
  case vpAvoidanceStatus::Unreachable:
    return "Unreachable";
  case vpAvoidanceStatus::Unsafe:
    return "Unsafe";
  case vpAvoidanceStatus::InvalidInput:
    break;
  }
  return "InvalidInput";
}

const char *vpMessage(vpAvoidanceStatus status)
{
  switch (status) {
  case vpAvoidanceStatus::Moving:
    return "The arm is on the direct way to the goal.";
  case vpAvoidanceStatus::Detouring:
    return "The arm goes round an obstacle, or slower behind it.";
  case vpAvoidanceStatus::Slowed:
    return "The arm moves slower than planned, so that it can stop in time.";
  case vpAvoidanceStatus::Waiting:
    return "The arm waits: there is no free way to the goal now.";
  case vpAvoidanceStatus::Arrived:
    return "The arm is at the goal.";
  case vpAvoidanceStatus::GoalInCollision:
    return "The arm waits: at the goal something would be nearer than the margin.";
  case vpAvoidanceStatus::StartInCollision:
    return "The arm stands: something is nearer to it than the margin.";
  case vpAvoidanceStatus::Unreachable:
    return "The arm stands: it cannot get to the goal, obstacles or not.";
  case vpAvoidanceStatus::Unsafe:
    return "The arm brakes, but something has come into its way to rest.";
  case vpAvoidanceStatus::InvalidInput:
    break;
  }
  return "The configuration or the goal is not finite, out of range or of a wrong size; the arm brakes.";
}

std::string vpMessage(const vpAvoidanceOutput &output, const vpCollisionScene &scene, double margin)
{
  const std::string plain = vpMessage(output.status);
  const std::size_t colon = plain.find(':');
  const bool aboutPair =
      output.status == vpAvoidanceStatus::StartInCollision || output.status == vpAvoidanceStatus::GoalInCollision;
  if (!aboutPair || output.pair.kind == vpCollisionKind::None || colon == std::string::npos) {
    return plain;
  }
  const std::string where = output.status == vpAvoidanceStatus::GoalInCollision ? " at the goal " : " ";
  return plain.substr(0, colon + 1) + where + vpPairText(scene, output.pair, margin) + ".";
}

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

std::unique_ptr<vpAvoidanceMethod> vpMakeAvoidanceMethod(const std::string &name, const vpCollisionScene &scene,
                                                         const vpAvoidanceMethodSpec &spec)
{
  if (name == "planner" || name == "planner-dtg") {
    vpPlannedMotionSpec full;
    full.common = spec;
    full.replanning = name == "planner-dtg" ? vpReplanning::OnTheFly : vpReplanning::FromRest;
    return std::make_unique<vpPlannedMotion>(scene, full);
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
