/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What a recording keeps of the command line, and how it comes back.
#include "options.h"

#include "numberText.h"
#include "recorded.h"

#include <visp3/core/vpMath.h>
#include <visp3/core/vpPoseVector.h>

#include <algorithm>
#include <filesystem>

namespace visualServo
{
namespace
{
std::string poseText(const vpHomogeneousMatrix &M)
{
  const vpPoseVector p(M);
  std::string text;
  for (unsigned int i = 0; i < 6; ++i) {
    text += (i > 0 ? "," : "") + vpApp::number(i < 3 ? p[i] : vpMath::deg(p[i]), 12);
  }
  return text;
}
} // namespace

Settings settingsOf(const Options &options, const vpHomogeneousMatrix &goal)
{
  const TargetOptions &target = options.target;
  Settings settings{{"--camera-xml", "camera.xml"}};
  if (!target.reference.empty()) {
    settings.emplace_back("--reference", "reference.png");
    settings.emplace_back("--distance", vpApp::number(target.nearest, 9) + "," + vpApp::number(target.farthest, 9));
  }
  else {
    settings.emplace_back("--goal-pose", poseText(goal));
  }
  if (options.camera.isFixed) {
    settings.emplace_back("--fMc", FIXED_CAMERA_FILE);
  }
  if (options.servo.objectMoves) {
    settings.emplace_back("--moving-target", "");
  }
  if (target.width > 0.) {
    settings.emplace_back("--size", vpApp::number(target.width, 9) + "," +
                                        vpApp::number(target.height > 0. ? target.height : target.width, 9));
  }
  if (target.tagFamily.empty() && target.reference.empty()) {
    settings.emplace_back("--target", "target.png");
  }
  else if (!target.tagFamily.empty()) {
    settings.emplace_back("--tag", target.tagFamily + ":" + std::to_string(target.tagId));
  }
  std::string laws;
  for (const std::string &law : options.laws) {
    laws += (laws.empty() ? "" : ",") + law;
  }
  const vpServoMotionLimits &limits = options.law.motion;
  const std::pair<const char *, double> numbers[] = {
      {"--lambda", options.law.gains.lambda},    {"--max-linear", limits.linearVelocity},
      {"--max-angular", limits.angularVelocity}, {"--max-acceleration", limits.linearAcceleration},
      {"--start-time", options.servo.startTime}, {"--image-timeout", options.servo.imageTimeout},
      {"--control-rate", options.controlRate}};
  settings.emplace_back("--law", laws);
  for (const auto &[name, value] : numbers) {
    settings.emplace_back(name, vpApp::number(value, 9));
  }
  settings.emplace_back("--tolerance", vpApp::number(1e3 * options.servo.positionTolerance, 9) + "," +
                                           vpApp::number(vpMath::deg(options.servo.rotationTolerance), 9));
  return settings;
}

std::vector<std::string> withRecorded(const std::string &folder, const std::vector<std::string> &arguments)
{
  const auto isGiven = [&arguments](const std::string &name) {
    return std::any_of(arguments.begin(), arguments.end(),
                       [&](const std::string &one) { return one.substr(0, one.find('=')) == name; });
  };
  // What the user looks for replaces the recorded target and its goal as a whole.
  const bool isOther = isGiven("--target") || isGiven("--tag") || isGiven("--reference");
  const bool hasGoal = isOther || isGiven("--goal") || isGiven("--goal-pose");
  std::vector<std::string> all;
  for (const auto &[name, value] : readSettings(folder)) {
    const bool isTarget = name == "--target" || name == "--tag" || name == "--size" || name == "--reference";
    const bool isFile = name == "--target" || name == "--reference" || name == "--camera-xml" || name == "--fMc";
    if (isGiven(name) || (isOther && isTarget) || (hasGoal && name == "--goal-pose")) {
      continue;
    }
    all.push_back(name);
    if (value.empty()) { // a flag
      continue;
    }
    all.push_back(isFile ? (std::filesystem::path(folder) / value).string() : value);
  }
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}
} // namespace visualServo
