/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "robot.h"

#include "appMain.h"
#include "dataFile.h"
#include "numberText.h"
#include "selfPairs.h"

#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace vpApp
{
namespace
{
namespace fs = std::filesystem;
using Limit = double vpArmJointSpec::*;

//! The reader names the command that expands a .xacro file.
bool isUrdf(const RobotOptions &options)
{
  const std::string suffix = fs::path(options.robot).extension().string();
  return suffix == ".urdf" || suffix == ".xacro";
}

//! Options for a URDF alone must not be lost on another file.
void requireNoUrdfOptions(const RobotOptions &options)
{
  const std::pair<const char *, bool> given[] = {{"--robot-base", !options.base.empty()},
                                                 {"--robot-tip", !options.tip.empty()},
                                                 {"--camera-link", !options.camera.empty()},
                                                 {"--tool-link", !options.tool.empty()},
                                                 {"--srdf", !options.srdf.empty()},
                                                 {"--package-path", !options.packagePaths.empty()},
                                                 {"--hold", !options.held.empty() || options.holdOthers},
                                                 {"--joint-limits", !options.jointLimits.empty()},
                                                 {"--home with the name of a state", !options.homeState.empty()}};
  for (const auto &[name, isGiven] : given) {
    if (isGiven) {
      throw UsageError(std::string(name) + " is for a .urdf file, the robot is " + options.robot);
    }
  }
}

vpArmModel loadUrdf(const RobotOptions &options)
{
  vpArmUrdfSpec urdf;
  urdf.base = options.base;
  urdf.tip = options.tip;
  urdf.camera = options.camera;
  urdf.tool = options.tool;
  urdf.srdf = options.srdf;
  urdf.packagePaths = options.packagePaths;
  urdf.held = options.held;
  urdf.holdOthers = options.holdOthers;
  urdf.limits = options.jointLimits;
  urdf.homeState = options.homeState;
  try {
    return vpLoadArmUrdf(options.robot, urdf);
  }
  catch (const vpException &error) { // of a field: of its option
    std::string sentence = error.getStringMessage();
    for (const auto &[field, option] :
         {std::pair("base", "robot-base"), {"tip", "robot-tip"}, {"camera", "camera-link"}, {"tool", "tool-link"}}) {
      for (const char *verb : {" is ", " must be "}) {
        const std::string begin = options.robot + ": " + field + verb;
        if (sentence.rfind(begin, 0) == 0) {
          throw vpException(vpException::badValue,
                            options.robot + ": --" + option + verb + sentence.substr(begin.size()));
        }
      }
    }
    throw;
  }
}

vpArmModel loadFile(const RobotOptions &options)
{
  if (isUrdf(options)) {
    return loadUrdf(options);
  }
  requireNoUrdfOptions(options);
  return vpLoadArmJson(options.robot == "amor" ? dataFile("robot/amor.json") : options.robot);
}

void requireCount(const char *option, std::size_t count, const vpArmSpec &arm, bool oneForAll)
{
  const std::size_t joints = arm.joints.size();
  if (count != joints && !(oneForAll && count == 1)) {
    throw UsageError(std::string(option) + " has " + std::to_string(count) + (count == 1 ? " number" : " numbers") +
                     ", must have " + (oneForAll ? "one or " : "") + std::to_string(joints) + ": " + arm.name +
                     " has " + std::to_string(joints) + (joints == 1 ? " joint" : " joints"));
  }
}

void setLimit(const char *option, const std::vector<double> &values, Limit limit, vpArmSpec &arm)
{
  if (values.empty()) {
    return;
  }
  requireCount(option, values.size(), arm, true);
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    arm.joints[i].*limit = values[values.size() == 1 ? 0 : i];
  }
}

void assumeAcceleration(vpArmSpec &arm)
{
  std::vector<std::string> names;
  for (vpArmJointSpec &joint : arm.joints) {
    if (std::isinf(joint.acceleration)) {
      joint.acceleration = assumedAcceleration;
      names.push_back(joint.name);
    }
  }
  if (!names.empty()) {
    arm.warnings.push_back(arm.source + ": acceleration limits of " +
                           (names.size() == arm.joints.size() ? "all joints" : enumerate(names)) + " are unknown, " +
                           number(assumedAcceleration, 6) +
                           " rad/s^2 or m/s^2 is assumed (--acceleration-limits or --joint-limits gives them)");
  }
}

bool contains(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> bodyNames(const vpArmSpec &arm)
{
  std::vector<std::string> names;
  for (const vpArmBody &body : arm.bodies) {
    names.push_back(body.name);
  }
  return names;
}

//! Adds the pairs that statistics allow, of bodies of the arm.
void allowPairs(const RobotOptions &options, vpArmSpec &arm)
{
  if (options.allowedPairs.empty()) {
    return;
  }
  const std::vector<std::string> known = bodyNames(arm);
  const vpSelfCollisionStatistics statistics = vpSelfCollisionStatistics::load(options.allowedPairs);
  if (statistics.arm != arm.source) {
    arm.warnings.push_back(options.allowedPairs + ": was made for " + statistics.arm + ", not for " + arm.source);
  }
  for (const auto &[first, second] : statistics.allowed()) {
    for (const std::string &name : {first, second}) {
      if (!contains(known, name)) {
        throw std::runtime_error(options.allowedPairs + ": " + arm.source + " has no link " + name);
      }
    }
    arm.allowedBodies.emplace_back(first, second);
  }
}

void requireBodies(const RobotOptions &options, const vpArmSpec &arm)
{
  const std::vector<std::string> known = bodyNames(arm);
  for (const std::string &name : options.ignored) {
    if (!contains(known, name)) {
      throw UsageError("--ignore-link: unknown link \"" + name + "\"; " +
                       (known.empty() ? options.robot + " has no named links" : "known are " + enumerate(known)));
    }
  }
}

//! Takes the capsules of ignored bodies away and names the bodies as uncovered, whatever their shape.
void ignoreBodies(const std::vector<std::string> &ignored, vpArmSpec &arm)
{
  arm.capsules.erase(std::remove_if(arm.capsules.begin(), arm.capsules.end(),
                                    [&](const vpArmCapsule &capsule) {
                                      return capsule.body >= 0 &&
                                             contains(ignored, arm.bodies[static_cast<std::size_t>(capsule.body)].name);
                                    }),
                     arm.capsules.end());
  for (const std::string &name : ignored) {
    if (!contains(arm.uncovered, name)) {
      arm.uncovered.push_back(name);
    }
  }
}
} // namespace

vpArmModel loadArm(const RobotOptions &options)
{
  const std::string suffix = fs::path(options.robot).extension().string();
  if (options.robot != "amor" && suffix != ".urdf" && suffix != ".json" && suffix != ".xacro") {
    std::string words;
    for (const std::string &word : options.words) {
      words += word + ", ";
    }
    throw UsageError(options.option + " is " + options.robot + ", must be " + words + "a .urdf or a .json file");
  }
  vpArmSpec arm = loadFile(options).spec();
  setLimit("--velocity-limits", options.velocity, &vpArmJointSpec::velocity, arm);
  setLimit("--acceleration-limits", options.acceleration, &vpArmJointSpec::acceleration, arm);
  if (isUrdf(options)) {
    assumeAcceleration(arm);
  }
  allowPairs(options, arm);
  if (!options.home.empty()) {
    requireCount("--home", options.home.size(), arm, false);
    arm.home = Eigen::Map<const Eigen::VectorXd>(options.home.data(), static_cast<int>(options.home.size()));
  }
  return vpArmModel(arm);
}

Robot loadRobot(const RobotOptions &options)
{
  const vpArmModel arm = loadArm(options);
  requireBodies(options, arm.spec());
  vpArmCoverSpec spec;
  spec.capsules = options.covers;
  spec.cacheFile = coverFileOf(options, arm.spec().name).string();
  spec.ignored = options.ignored;
  if (!spec.cacheFile.empty() && !arm.spec().shapes.empty()) {
    std::error_code ignored; // vpCoverArm() tells of a file that cannot be written
    fs::create_directories(fs::path(spec.cacheFile).parent_path(), ignored);
  }
  vpArmCover cover = vpCoverArm(arm, spec);
  vpArmSpec covered = cover.arm.spec();
  ignoreBodies(options.ignored, covered);

  Robot robot;
  robot.covers = std::move(cover.bodies);
  robot.ignored = options.ignored;
  robot.warnings = arm.spec().warnings;
  robot.warnings.insert(robot.warnings.end(), cover.warnings.begin(), cover.warnings.end());
  std::copy_if(covered.uncovered.begin(), covered.uncovered.end(), std::back_inserter(robot.unseen),
               [&](const std::string &name) { return !contains(options.ignored, name); });
  if (options.srdf.empty() && options.allowedPairs.empty()) {
    const SelfPairs pairs = findSelfPairs(vpArmModel(covered), fs::path(spec.cacheFile).parent_path());
    covered.allowedBodies.insert(covered.allowedBodies.end(), pairs.allowed.begin(), pairs.allowed.end());
    robot.warnings.insert(robot.warnings.end(), pairs.warnings.begin(), pairs.warnings.end());
  }
  robot.arm = std::make_shared<const vpArmModel>(covered);
  return robot;
}

std::string unseenSentence(const Robot &robot)
{
  const std::string label = robot.arm->label();
  if (!robot.unseen.empty()) {
    return label + ": collision checks would not see " + (robot.unseen.size() == 1 ? "link " : "links ") +
           enumerate(robot.unseen) +
           "; --package-path tells where meshes are, --hold that a joint beside the chain never moves, --ignore-link "
           "that nothing can touch a link";
  }
  return robot.arm->spec().capsules.empty() ? label + ": no link has a shape, collisions cannot be checked" : "";
}

std::vector<std::string> jointsBehind(const vpArmModel &arm, int link)
{
  std::vector<std::string> behind;
  for (int i = 0; i < arm.size(); ++i) {
    int k = 0;
    while (k < link && arm.chain(k).joint != i) {
      ++k;
    }
    if (k == link) {
      behind.push_back(arm.spec().joints[static_cast<std::size_t>(i)].name);
    }
  }
  return behind;
}

void warnOfJointsBehind(const vpArmModel &arm, const std::string &frame, int link, std::vector<std::string> &warnings)
{
  const std::vector<std::string> behind = jointsBehind(arm, link);
  if (!behind.empty()) {
    warnings.push_back(arm.label() + ": the " + frame + " is on link " + std::to_string(link) + ", not moved by " +
                       enumerate(behind));
  }
}

std::string missingLimitSentence(const vpArmModel &arm)
{
  for (const vpArmJointSpec &joint : arm.spec().joints) {
    const bool velocity = std::isinf(joint.velocity);
    if (velocity || std::isinf(joint.acceleration)) {
      const std::string kind = velocity ? "velocity" : "acceleration";
      return arm.label() + ": joint " + joint.name + " has no " + kind + " limit, --" + kind +
             "-limits or, for a URDF, --joint-limits gives it";
    }
  }
  return "";
}

std::string crowdedSentence(const vpArmModel &arm, double share)
{
  std::vector<std::string> names;
  const vpSelfCollisionStatistics contacts = capsuleContacts(arm, keptClearance);
  for (const vpBodyPairStatistics &pair : contacts.pairs) {
    if (pair.touching >= share * contacts.samples) {
      names.push_back(pair.first + " and " + pair.second);
    }
  }
  return names.empty()
             ? ""
             : arm.label() + ": the capsules of " + enumerate(names) + " are nearer than " +
                   number(1000. * keptClearance, 2) + " mm in " + (share < 1. ? "nearly " : "") + "all of " +
                   std::to_string(contacts.samples) +
                   " random configurations, where nothing is planned; --covers 6 encloses meshes more closely, "
                   "--srdf or --allowed-pairs tells which pairs need no check, visp-arm --write-pairs finds them";
}

Robot loadUsableRobot(const RobotOptions &options)
{
  constexpr double nearly = 0.95;
  Robot robot = loadRobot(options);
  for (const std::string &sentence :
       {unseenSentence(robot), missingLimitSentence(*robot.arm), crowdedSentence(*robot.arm, 1.)}) {
    if (!sentence.empty()) {
      throw std::runtime_error(sentence);
    }
  }
  const std::string crowded = crowdedSentence(*robot.arm, nearly);
  if (!crowded.empty()) {
    robot.warnings.push_back(crowded);
  }
  return robot;
}

std::filesystem::path coverFileOf(const RobotOptions &options, const std::string &name)
{
  if (!options.coverFile.empty()) {
    return options.coverFile;
  }
  const char *cache = std::getenv("XDG_CACHE_HOME");
  const char *home = std::getenv("HOME");
  fs::path folder;
  if (cache != nullptr && fs::path(cache).is_absolute()) { // others are to be ignored, says the standard
    folder = cache;
  }
  else if (home != nullptr && *home != '\0') {
    folder = fs::path(home) / ".cache";
  }
  return folder.empty() ? folder : folder / "visp-direct" / (fileName(name) + ".covers.json");
}

void printWarnings(const std::string &program, const std::vector<std::string> &warnings)
{
  for (const std::string &warning : warnings) {
    std::cerr << program << ": " << warning << "\n";
  }
}
} // namespace vpApp
