/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What random configurations tell: one that reaches a goal, and which capsules and bodies of an arm touch.
#include "vpExactQuery.h"

#include <visp3/avoidance/vpExactChecker.h>
#include <visp3/avoidance/vpGoalConfiguration.h>
#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double period = 0.02; // s, of a virtual motion of which only the end is used
constexpr int longest = 1500;   // periods

//! Evenly distributed between the position limits; a continuous joint in one full turn.
vpJointVector randomConfiguration(const vpArmModel &arm, std::mt19937_64 &random)
{
  vpJointVector q(arm.size());
  for (int j = 0; j < arm.size(); ++j) {
    const double low = arm.isContinuous(j) ? -M_PI : arm.lower()(j), high = arm.isContinuous(j) ? M_PI : arm.upper()(j);
    q(j) = std::uniform_real_distribution<double>(low, high)(random);
  }
  return q;
}

std::optional<vpJointVector> reach(vpClosedLoopKinematics &kinematics, const vpArmModel &arm,
                                   const Eigen::Vector3d &position, const vpJointVector &from)
{
  vpArmData data;
  vpArmKinematics::forward(arm, from, data);
  vpClosedLoopInput input;
  input.goal = {data.tool.R, position};
  input.free = {false, false, false, true, true, true};
  input.indices[0] = vpSelfMotionIndex::jointLimits();
  input.indexCount = 1;
  vpClosedLoopState state;
  state.q = from;
  vpClosedLoopOutput output;
  for (int i = 0; i < longest; ++i) {
    kinematics.step(input, state, output);
    if (output.status != vpClosedLoopStatus::Moving) {
      break;
    }
  }
  return output.status == vpClosedLoopStatus::Reached ? std::optional<vpJointVector>(state.q) : std::nullopt;
}
} // namespace

const char *vpGoalConfiguration::message() const noexcept
{
  switch (status) {
  case vpGoalConfigurationStatus::Free:
    return "Free: a configuration that keeps the margin was found.";
  case vpGoalConfigurationStatus::InCollision:
    return "InCollision: no configuration was found at the goal that keeps the margin.";
  case vpGoalConfigurationStatus::Unreachable:
    return "Unreachable: no configuration was found that brings the end effector to the goal.";
  }
  return "";
}

vpGoalConfiguration vpFindGoalConfiguration(const vpCollisionScene &scene, const vpJointVector &from,
                                            const Eigen::Vector3d &position, double margin, int attempts,
                                            unsigned int seed)
{
  const vpArmModel &arm = scene.arm();
  if (from.size() != arm.size() || !(from.cwiseAbs().array() <= vpLargestCoordinate).all() ||
      !(position.cwiseAbs().array() <= vpLargestLength).all()) {
    throw vpException(
        vpException::badValue,
        "a goal configuration is sought from %d numbers, arm %s has %d joints; all must be finite and in range",
        static_cast<int>(from.size()), arm.label().c_str(), arm.size());
  }
  vpRedundancySpec redundancy;
  redundancy.period = period;
  vpClosedLoopSpec spec;
  spec.maxLinear = 3.;
  spec.stallTime = 1.;
  vpClosedLoopKinematics kinematics(arm, redundancy, spec);
  std::mt19937_64 random(seed);
  vpGoalConfiguration found;
  vpExactChecker checker(scene);
  vpJointVector start = from;
  for (int attempt = 0; attempt < attempts; ++attempt, start = randomConfiguration(arm, random)) {
    const std::optional<vpJointVector> q = reach(kinematics, arm, position, start);
    if (!q) {
      continue;
    }
    if (!checker.inCollision(*q, margin)) {
      return {vpGoalConfigurationStatus::Free, *q};
    }
    if (found.status == vpGoalConfigurationStatus::Unreachable) {
      found = {vpGoalConfigurationStatus::InCollision, *q};
    }
  }
  return found;
}

namespace
{
// The scene of an arm without objects and without allowed pairs of bodies.
vpCollisionScene sceneOf(const vpArmModel &arm, const std::shared_ptr<const vpExactShapes> &exact)
{
  vpArmSpec spec = arm.spec();
  spec.allowedBodies.clear();
  vpCollisionSceneSpec scene;
  scene.ignoredBodies = spec.uncovered;
  scene.exact = exact;
  return vpCollisionScene(vpArmModel(spec), scene);
}

// Two bodies and their capsules.
struct BodyPair {
  int first, second;
  std::vector<vpSelfPair> capsules;
  vpExactPair exact;
};

std::vector<BodyPair> bodyPairs(const vpCollisionScene &scene)
{
  std::vector<BodyPair> pairs;
  for (const vpSelfPair &pair : scene.selfPairs()) {
    const int first = scene.capsule(pair.first).body, second = scene.capsule(pair.second).body;
    if (first < 0 || second < 0) {
      continue;
    }
    auto known = std::find_if(pairs.begin(), pairs.end(), [first, second](const BodyPair &other) {
      return other.first == first && other.second == second;
    });
    if (known == pairs.end()) {
      pairs.push_back({first, second, {}, vpExactQuery::pairOf(scene, vpCollisionKind::Self, pair.second, pair.first)});
      known = pairs.end() - 1;
    }
    known->capsules.push_back(pair);
  }
  return pairs;
}

double leastOf(const vpCollisionScene &scene, const vpCollisionData &data, const BodyPair &pair)
{
  double least = std::numeric_limits<double>::infinity();
  for (const vpSelfPair &one : pair.capsules) {
    least = std::min(least, scene.selfPair(data, one.first, one.second).distance);
  }
  return least;
}

//! \param capsules : Least clearance of their capsules.
bool areTouching(const vpCollisionScene &scene, const vpCollisionData &data, const BodyPair &pair, double capsules,
                 vpExactQuery &query)
{
  constexpr double nearly = 1e-9; // m: more makes no difference
  return !(capsules > 0.) && (pair.exact.kind == vpCollisionKind::None ||
                              query.clearance(scene, data, pair.exact, nearly, true).distance <= 0.);
}
} // namespace

vpSelfCollisionStatistics vpSampleBodyPairs(const vpArmModel &arm, const std::shared_ptr<const vpExactShapes> &exact,
                                            int samples, unsigned int seed)
{
  if (samples <= 0) {
    throw vpException(vpException::badValue, "number of samples is %d, must be > 0", samples);
  }
  const vpCollisionScene scene = sceneOf(arm, exact);
  const std::vector<BodyPair> pairs = bodyPairs(scene);
  vpSelfCollisionStatistics result{arm.label(), samples, seed, {}};
  vpCollisionData data;
  vpExactQuery query;
  scene.place(vpJointVector::Zero(arm.size()).cwiseMax(arm.lower()).cwiseMin(arm.upper()), data);
  for (const BodyPair &pair : pairs) {
    const auto name = [&arm](int body) { return arm.spec().bodies[static_cast<std::size_t>(body)].name; };
    result.pairs.push_back({name(pair.first), name(pair.second), 0,
                            areTouching(scene, data, pair, leastOf(scene, data, pair), query),
                            pair.exact.kind != vpCollisionKind::None});
  }
  std::mt19937_64 generator(seed);
  for (int k = 0; k < samples; ++k) {
    scene.place(randomConfiguration(arm, generator), data);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double least = leastOf(scene, data, pairs[i]);
      result.pairs[i].least = std::min(result.pairs[i].least, least);
      result.pairs[i].touching += areTouching(scene, data, pairs[i], least, query) ? 1 : 0;
    }
  }
  return result;
}

END_VISP_NAMESPACE
