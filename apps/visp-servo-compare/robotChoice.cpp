/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "robotChoice.h"

#include "appMain.h"
#include "dataFile.h"
#include "format.h"

#include <visp3/core/vpMath.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>
#include "lab/servo/vpServoStart.h"

#include <filesystem>

namespace servoCompare
{
namespace
{
vpArmModel loadArm(const RobotOptions &options)
{
  if (options.robot == "amor") {
    return vpLoadArmJson(vpApp::dataFile("robot/amor.json"));
  }
  const std::string suffix = std::filesystem::path(options.robot).extension().string();
  if (suffix == ".json") {
    return vpLoadArmJson(options.robot);
  }
  if (suffix != ".urdf") {
    throw vpApp::UsageError("--robot is " + options.robot + ", must be camera, amor, a .urdf or a .json file");
  }
  vpArmUrdfSpec urdf;
  urdf.base = options.base;
  urdf.tip = options.tip;
  urdf.camera = options.camera;
  urdf.acceleration = options.acceleration;
  return vpLoadArmUrdf(options.robot, urdf);
}

std::vector<vpSelfMotionIndex> indicesOf(const RobotOptions &options, const vpArmModel &model)
{
  std::vector<vpSelfMotionIndex> indices;
  for (const std::string &name : options.selfMotion) {
    if (name == "limits") {
      indices.push_back(vpSelfMotionIndex::jointLimits());
    }
    else if (name == "manipulability") {
      indices.push_back(vpSelfMotionIndex::manipulability());
    }
    else if (name == "posture") {
      indices.push_back(vpSelfMotionIndex::posture(model.home()));
    }
    else if (name != "none" || options.selfMotion.size() > 1) {
      throw vpApp::UsageError("--self-motion: unknown wish \"" + name +
                              "\"; known are limits, manipulability, posture, or none alone");
    }
  }
  return indices;
}

vpLimitPolicy policyOf(const RobotOptions &options)
{
  if (options.limits != "stop" && options.limits != "scale") {
    throw vpApp::UsageError("--limits is " + options.limits + ", must be stop or scale");
  }
  return options.limits == "stop" ? vpLimitPolicy::StopJoints : vpLimitPolicy::ScaleMotion;
}

std::string listOf(const vpArmModel &model, const vpJointVector &q)
{
  std::string text;
  for (int i = 0; i < model.size(); ++i) {
    text += (i > 0 ? ", " : "") + (model.isPrismatic(i) ? fixed(q(i), 3) + " m" : fixed(vpMath::deg(q(i)), 1));
  }
  return text;
}
} // namespace

std::shared_ptr<const vpServoArm> chooseArm(const RobotOptions &options, const vpServoTask &task)
{
  const vpLimitPolicy policy = policyOf(options);
  if (options.robot == "camera") {
    return nullptr;
  }
  auto arm = std::make_shared<vpServoArm>(vpServoArm{loadArm(options), {}});
  arm->spec.indices = indicesOf(options, arm->model);
  arm->spec.redundancy.policy = policy;
  arm->spec.validate(arm->model);
  arm->spec.start = findServoStart(arm->model, task);
  return arm;
}

std::string sentenceOf(const vpServoArm &arm)
{
  std::string wishes;
  for (const vpSelfMotionIndex &index : arm.spec.indices) {
    wishes += (wishes.empty() ? "" : ", ") +
              std::string(index.kind == vpIndexKind::JointLimits ? "away from joint limits"
                          : index.kind == vpIndexKind::Posture   ? "near the posture of the start"
                                                                 : "away from singularities");
  }
  const int n = arm.model.size();
  return arm.model.spec().name + ", " + std::to_string(n) + " joints, starts at (" + listOf(arm.model, arm.spec.start) +
         ") deg; " +
         (n <= 6           ? "no joint is to spare"
          : wishes.empty() ? "the spare joint does nothing"
                           : "the spare joint leads it " + wishes) +
         "; at position limits " +
         (arm.spec.redundancy.policy == vpLimitPolicy::StopJoints ? "only the joint concerned stops."
                                                                  : "the whole motion is slowed down.");
}
} // namespace servoCompare
