/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "description.h"

#include "appMain.h"
#include "numberText.h"
#include "selfPairs.h"

#include "lab/avoidance/vpSceneFrame.h"
#include <visp3/manipulator/vpSrdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace armProgram
{
namespace
{
bool contains(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

Names ordered(const std::string &a, const std::string &b) { return a < b ? Names(a, b) : Names(b, a); }

//! The same robot without the options that set limits.
std::optional<vpArmModel> withFileLimits(vpApp::RobotOptions options)
{
  if (options.jointLimits.empty() && options.velocity.empty() && options.acceleration.empty()) {
    return std::nullopt;
  }
  options.jointLimits.clear();
  options.velocity.clear();
  options.acceleration.clear();
  return vpApp::loadArm(options);
}

std::vector<LimitSource> sourcesOf(const vpArmModel &arm, const vpApp::RobotOptions &options)
{
  const bool urdf = std::filesystem::path(options.robot).extension() == ".urdf";
  const std::optional<vpArmModel> plain = withFileLimits(options);
  const auto source = [&](double value, double inFile, bool byOption, const char *option) -> std::string {
    return std::isinf(value) ? "unknown" : byOption ? option : value != inFile ? "--joint-limits" : "file";
  };
  std::vector<LimitSource> sources;
  for (std::size_t i = 0; i < arm.spec().joints.size(); ++i) {
    const vpArmJointSpec &joint = arm.spec().joints[i];
    const vpArmJointSpec &file = plain ? plain->spec().joints[i] : joint;
    LimitSource limits;
    limits.position = joint.type == vpJointType::Continuous                    ? "none"
                      : joint.lower != file.lower || joint.upper != file.upper ? "--joint-limits"
                                                                               : "file";
    limits.velocity = source(joint.velocity, file.velocity, !options.velocity.empty(), "--velocity-limits");
    limits.acceleration =
        source(joint.acceleration, file.acceleration, !options.acceleration.empty(), "--acceleration-limits");
    if (urdf && limits.acceleration == "file") { // which has none
      limits.acceleration = "assumed";
    }
    sources.push_back(limits);
  }
  return sources;
}

Link describeBody(const vpApp::Robot &robot, std::size_t i)
{
  const vpArmSpec &arm = robot.arm->spec();
  Link link;
  link.name = arm.bodies[i].name;
  link.link = arm.bodies[i].link;
  const auto ofBody = [i](const auto &part) { return part.body == static_cast<int>(i); };
  link.covers = static_cast<int>(std::count_if(arm.capsules.begin(), arm.capsules.end(), ofBody));
  const bool unseen = contains(robot.unseen, link.name);
  const bool hasShape = std::any_of(arm.shapes.begin(), arm.shapes.end(), ofBody);
  link.geometry = contains(robot.ignored, link.name) ? "ignored"
                  : unseen                           ? (hasShape ? "mesh" : "none")
                  : link.covers > 0                  ? "cover"
                                                     : "none";
  for (const vpBodyCover &cover : robot.covers) {
    if (cover.body == link.name) {
      link.fit = cover;
    }
  }
  return link;
}

//! A JSON file has links but no bodies.
std::vector<Link> describeLinks(const vpArmModel &arm)
{
  std::vector<Link> links;
  for (int i = 0; i <= arm.links(); ++i) {
    Link link;
    link.link = i;
    link.name = linkName(arm, i);
    link.covers = static_cast<int>(std::count_if(arm.spec().capsules.begin(), arm.spec().capsules.end(),
                                                 [i](const vpArmCapsule &capsule) { return capsule.link == i; }));
    link.geometry = link.covers > 0 ? "cover" : "none";
    links.push_back(link);
  }
  return links;
}

//! Pairs that need no check, with the reason.
std::map<Names, std::string> allowedOf(const vpArmModel &arm, const vpApp::RobotOptions &options)
{
  std::map<Names, std::string> allowed;
  for (const auto &[first, second] : arm.spec().allowedBodies) {
    allowed[ordered(first, second)] = options.allowedPairs.empty() ? "by 10,000 random configurations, see the warnings"
                                                                   : "allowed by " + options.allowedPairs;
  }
  if (!options.srdf.empty()) {
    for (const vpSrdfPair &pair : vpLoadSrdf(options.srdf).disabled) {
      allowed[ordered(pair.first, pair.second)] =
          "disabled in the SRDF" + (pair.reason.empty() ? "" : " (" + pair.reason + ")");
    }
  }
  return allowed;
}

std::vector<Pair> pairsOf(const vpArmModel &arm, const vpCollisionScene &scene,
                          const std::map<Names, std::string> &allowed)
{
  std::set<Names> checked;
  for (const vpSelfPair &pair : scene.selfPairs()) {
    checked.insert(ordered(bodyOf(arm, pair.first), bodyOf(arm, pair.second)));
  }
  std::vector<Pair> pairs;
  std::set<Names> seen;
  const std::vector<vpArmCapsule> &capsules = arm.spec().capsules;
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    for (std::size_t j = i + 1; j < capsules.size(); ++j) {
      const Names names = ordered(bodyOf(arm, static_cast<int>(i)), bodyOf(arm, static_cast<int>(j)));
      if (capsules[i].link != capsules[j].link && seen.insert(names).second) {
        pairs.push_back({names.first, names.second,
                         checked.count(names) > 0   ? ""
                         : allowed.count(names) > 0 ? allowed.at(names)
                                                    : "neighbours"});
      }
    }
  }
  return pairs;
}

//! Checked pairs of bodies whose capsules touch in nearly all random configurations: "a and b".
std::vector<std::string> alwaysTouching(const vpArmModel &arm)
{
  std::vector<std::string> pairs;
  const vpSelfCollisionStatistics statistics = vpApp::capsuleContacts(arm, 0.);
  for (const vpBodyPairStatistics &pair : statistics.pairs) {
    if (statistics.rule(pair) == vpContactRule::Always) {
      pairs.push_back(pair.first + " and " + pair.second);
    }
  }
  return pairs;
}

//! What the model alone cannot tell: contacts.
void examineContacts(const vpApp::Robot &robot, const vpApp::RobotOptions &options, Description &description)
{
  constexpr int poses = 1000;
  constexpr double many = 0.5, nearly = 0.95;
  const vpArmModel &arm = *robot.arm;
  const vpCollisionScene scene = sceneOf(robot);
  const std::map<Names, std::string> allowed = allowedOf(arm, options);
  description.pairs = pairsOf(arm, scene, allowed);
  std::vector<std::string> touching;
  for (const Names &pair : touchesAt(scene, arm.home())) {
    touching.push_back(pair.first + " and " + pair.second);
  }
  const double share = vpSelfTouchShare(scene, poses);
  const std::vector<std::string> always = alwaysTouching(arm);
  const std::string inMany = arm.label() + ": capsules of the arm touch each other in " +
                             vpApp::fixed(100. * share, 1) + " % of " + std::to_string(poses) +
                             " random configurations" +
                             (always.empty() ? "" : ", those of " + vpApp::enumerate(always) + " in nearly all"),
                    advice = "; --srdf or --allowed-pairs tells which pairs need no check, --write-pairs finds them";
  if (share == 1.) {
    description.problems.push_back(inMany + ", no motion is free" + advice);
  }
  else if (share > many) {
    description.warnings.push_back(inMany + advice);
  }
  const std::string crowded = vpApp::crowdedSentence(arm, nearly);
  if (!crowded.empty()) {
    description.warnings.push_back(crowded);
  }
  if (!touching.empty()) {
    description.warnings.push_back(arm.label() + ": " + vpApp::enumerate(touching) + " touch at home" + advice);
  }
}
} // namespace

vpCollisionScene sceneOf(const vpApp::Robot &robot, vpCollisionSceneSpec spec)
{
  return vpCollisionScene(*robot.arm, vpIgnoreUncovered(*robot.arm, std::move(spec)));
}

Description describe(const vpApp::Robot &robot, const vpApp::RobotOptions &options)
{
  const vpArmModel &arm = *robot.arm;
  Description description;
  description.sources = sourcesOf(arm, options);
  for (std::size_t i = 0; i < arm.spec().bodies.size(); ++i) {
    description.links.push_back(describeBody(robot, i));
  }
  if (description.links.empty()) {
    description.links = describeLinks(arm);
  }
  description.coverFile = robot.covers.empty() ? "" : vpApp::coverFileOf(options, robot.arm->spec().name).string();
  description.reach = vpSceneFrame::of(arm).reach;
  description.warnings = robot.warnings;
  for (const std::string &limit : {vpApp::missingLimitSentence(arm)}) {
    if (!limit.empty()) {
      description.warnings.push_back(limit);
    }
  }
  const std::string unseen = vpApp::unseenSentence(robot);
  if (!unseen.empty()) {
    description.problems.push_back(unseen);
  }
  if (!arm.spec().capsules.empty()) {
    try {
      examineContacts(robot, options, description);
    }
    catch (const std::exception &error) { // more capsules than a scene takes, for one
      description.problems.push_back(vpApp::sentenceOf(error));
    }
  }
  return description;
}

} // namespace armProgram
