/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpAvoidanceMethod.h>

#include "vpFieldCheck.h"
#include "vpPairText.h"
#include "vpRegistry.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>
#include <visp3/avoidance/vpPlannedMotion.h>
#include <visp3/avoidance/vpPotentialFieldAvoidance.h>
#include <visp3/core/vpException.h>

#include <cmath>
#include <memory>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the avoidance method");
// rad/s or m/s: a braking arm slower than this counts as standing.
constexpr double standing = 1e-3;

struct Methods : vpRegistry<vpAvoidanceMethodMaker> {
  Methods() : vpRegistry("avoidance method")
  {
    const auto field = [](vpFieldForm form) {
      return [form](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec) {
        vpPotentialFieldAvoidanceSpec full;
        full.common = spec;
        full.form = form;
        return std::make_unique<vpPotentialFieldAvoidance>(scene, full);
      };
    };
    const auto direct = [](vpDetourKind detour) {
      return [detour](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec) {
        vpDirectTrajectoryAvoidanceSpec full;
        full.common = spec;
        full.detour = detour;
        return std::make_unique<vpDirectTrajectoryAvoidance>(scene, full);
      };
    };
    const auto planned = [](vpReplanning replanning) {
      return [replanning](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec) {
        vpPlannedMotionSpec full;
        full.common = spec;
        full.replanning = replanning;
        return std::make_unique<vpPlannedMotion>(scene, full);
      };
    };
    add("potential", "is pushed aside in the image, as the thesis prints it (8.1)-(8.2): touches and overshoots",
        field(vpFieldForm::Thesis));
    add("potential-corrected", "is pushed away from the obstacle, within bounds of speed and joints",
        field(vpFieldForm::Corrected));
    add("dtg", "takes another final position beside the obstacle until the way to the goal is free",
        direct(vpDetourKind::PointToPoint));
    add("dtg-via", "takes via positions round the obstacle, the shortest way first", direct(vpDetourKind::Via));
    add("planner", "brakes, and replans at rest", planned(vpReplanning::FromRest));
    add("planner-dtg", "replans from the moving state, and brakes only if there is no way",
        planned(vpReplanning::OnTheFly));
  }
};

Methods &methods()
{
  static Methods all; // at first use: static objects elsewhere may add methods
  return all;
}
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

std::vector<std::string> vpAvoidanceMethodNames() { return methods().ids(); }

std::string vpAvoidanceMethodMessage(const std::string &name) { return methods().sentence(name); }

void vpAddAvoidanceMethod(const std::string &name, const std::string &sentence, vpAvoidanceMethodMaker maker)
{
  methods().add(name, sentence, std::move(maker));
}

std::unique_ptr<vpAvoidanceMethod> vpMakeAvoidanceMethod(const std::string &name, const vpCollisionScene &scene,
                                                         const vpAvoidanceMethodSpec &spec)
{
  std::unique_ptr<vpAvoidanceMethod> method = methods().find(name)(scene, spec);
  if (!method) {
    throw vpException(vpException::badValue, "the maker of avoidance method \"%s\" returned none", name.c_str());
  }
  return method;
}

END_VISP_NAMESPACE
