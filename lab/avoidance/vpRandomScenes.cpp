/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpSceneDraw.h"
#include "vpFieldCheck.h"

#include "lab/avoidance/vpTrueScene.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

// S2: random static scenes.

namespace
{
constexpr double least = 0.3, most = 0.8; // m, distance of the tool positions
constexpr unsigned int staticNumber = 2;

vpCollisionShape randomShape(vpHashRandom &random, double scale)
{
  const auto kind = static_cast<int>(random.uniform(0., 4.));
  const double radius = scale * random.uniform(0.03, 0.12), length = scale * random.uniform(0.06, 0.6);
  const Eigen::Vector3d size(scale * random.uniform(0.06, 0.4), scale * random.uniform(0.06, 0.4),
                             scale * random.uniform(0.06, 0.4));
  switch (kind) {
  case 0:
    return vpCollisionShape::sphere(radius);
  case 1:
    return vpCollisionShape::capsule(0.5 * radius, length);
  case 2:
    return vpCollisionShape::box(size);
  default:
    return vpCollisionShape::cylinder(radius, length);
  }
}

//! Random position within reach, but outside the arm's foot.
Eigen::Vector3d randomPlace(vpHashRandom &random)
{
  const double angle = random.uniform(-M_PI, M_PI), distance = random.uniform(0.3, 1.), z = random.uniform(0.05, 0.9);
  return {distance * std::cos(angle), distance * std::sin(angle), z};
}

vpCollisionSceneSpec randomScene(const vpArmModel &arm, const vpSceneFrame &frame, vpHashRandom &random)
{
  vpCollisionSceneSpec spec = vpIgnoreUncovered(arm);
  spec.ground = frame.floor();
  const int count = 3 + static_cast<int>(random.uniform(0., 8.));
  for (int i = 0; i < count; ++i) {
    vpCollisionObject object;
    object.name = "obstacle " + std::to_string(i + 1);
    object.shape = randomShape(random, frame.scale);
    object.pose.p = frame.place(randomPlace(random));
    object.pose.R = vpSO3::exp(random.uniform(0., M_PI) * vpSceneDraw::direction(random));
    spec.objects.push_back(object);
  }
  return spec;
}

//! True if the straight motion collides; samples suffice to prove that.
bool touches(const vpCollisionScene &scene, const vpJointVector &start, const vpJointVector &goal)
{
  constexpr int places = 200;
  for (int i = 0; i <= places; ++i) {
    if (!vpSceneDraw::isFree(scene, start + static_cast<double>(i) / places * (goal - start), 0.)) {
      return true;
    }
  }
  return false;
}

//! True if the straight tool motion is possible, but collides.
bool toolTouches(const vpCollisionScene &scene, const vpJointVector &start, const vpJointVector &goal)
{
  const std::vector<vpJointVector> line = vpSceneDraw::toolLine(scene.arm(), start, goal, 60);
  return std::any_of(line.begin(), line.end(),
                     [&](const vpJointVector &q) { return !vpSceneDraw::isFree(scene, q, 0.); });
}

//! Start and goal free and at some distance, neither straight motion free, a path known.
bool isGood(const vpCollisionScene &scene, const vpJointVector &start, const vpJointVector &goal, double scale,
            unsigned int seed)
{
  const vpArmModel &arm = scene.arm();
  const double way = (vpSceneDraw::tool(arm, goal) - vpSceneDraw::tool(arm, start)).norm() / scale;
  if (way < least || way > most || !vpSceneDraw::isFree(scene, start, vpAvoidanceScenes::feasibleMargin) ||
      !vpSceneDraw::isFree(scene, goal, vpAvoidanceScenes::feasibleMargin)) {
    return false;
  }
  return touches(scene, start, goal) && toolTouches(scene, start, goal) &&
         vpSceneDraw::hasPath(scene, start, goal, seed);
}
} // namespace

vpAvoidanceScenario vpAvoidanceScenes::randomStatic(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed)
{
  vpSceneDraw::requireArm(arm);
  const vpSceneFrame frame = vpSceneFrame::of(*arm);
  for (int draw = 0; draw < vpSceneDraw::mostDraws; ++draw) {
    vpHashRandom random = vpSceneDraw::random(staticNumber, seed, draw);
    const vpCollisionSceneSpec spec = randomScene(*arm, frame, random);
    const vpJointVector start = vpSceneDraw::configuration(*arm, random);
    const vpJointVector goal = vpSceneDraw::shortWay(*arm, start, vpSceneDraw::configuration(*arm, random));
    if (isGood(vpCollisionScene(*arm, spec), start, goal, frame.scale, seed)) {
      vpAvoidanceScenario scenario;
      scenario.name = "S2 number " + std::to_string(seed);
      scenario.run = vpSceneDraw::between(arm, start, goal, seed);
      scenario.run.scene = spec;
      scenario.run.visionRate = 5.; // nothing moves
      scenario.draws = draw + 1;
      return scenario;
    }
  }
  vpSceneDraw::giveUp("S2", seed);
}

// S3: crossing obstacles.

namespace
{
constexpr unsigned int crossingNumber = 3;
constexpr double step = 0.01;      // s, time step for checking the conditions
constexpr double jointShare = 0.5; // fraction of the joint speeds of the blind arm
constexpr double toolSpeed = 0.25; // m/s, mean speed of the blind tool
constexpr int wayPlaces = 60;

//! \brief A blind arm: configurations in equal time steps.
struct Blind {
  std::vector<vpJointVector> way;
  double duration = 0.; // s

  [[nodiscard]] const vpJointVector &at(double share) const
  {
    const double last = static_cast<double>(way.size()) - 1.;
    return way[static_cast<std::size_t>(std::lround(std::clamp(share, 0., 1.) * last))];
  }
};

double timeOf(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal)
{
  return ((goal - start).cwiseAbs().array() / (jointShare * arm.velocity().array())).maxCoeff();
}

Blind alongJoints(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal)
{
  Blind blind;
  blind.duration = timeOf(arm, start, goal);
  for (int i = 0; i < wayPlaces; ++i) {
    blind.way.push_back(start + static_cast<double>(i) / (wayPlaces - 1) * (goal - start));
  }
  return blind;
}

Blind alongLine(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal)
{
  const double length = (vpSceneDraw::tool(arm, goal) - vpSceneDraw::tool(arm, start)).norm();
  return {vpSceneDraw::toolLine(arm, start, goal, wayPlaces), length / toolSpeed};
}

//! Obstacle that meets the tool of the blind arm on its path, at about the same time.
vpMovingObstacle randomObstacle(vpHashRandom &random, int i, const vpArmModel &arm, const Blind &blind, double speed)
{
  vpMovingObstacle o;
  o.object.name = "mover " + std::to_string(i + 1);
  const double radius = random.uniform(0.04, 0.08), length = random.uniform(0.1, 0.3);
  o.object.shape = i % 2 == 0 ? vpCollisionShape::sphere(radius) : vpCollisionShape::capsule(0.7 * radius, length);
  const double angle = random.uniform(-M_PI, M_PI), along = random.uniform(0.3, 0.9);
  const Eigen::Vector3d v = speed * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.);
  const double when = along * blind.duration + random.uniform(-0.1, 0.1);
  o.object.pose.p = vpSceneDraw::tool(arm, blind.at(along)) - when * v;
  o.object.pose.p.z() += random.uniform(-0.05, 0.05);
  o.object.velocity = vpTwist(v.x(), v.y(), v.z(), 0., 0., 0.);
  return o;
}

//! True if waiting at the start until nothing is near the path, and then moving, is free.
bool canWait(vpTrueScene &truth, const vpJointVector &start, const vpJointVector &goal, double longest)
{
  vpMotionScratch scratch;
  const vpCertifiedMotion motion(truth.scene(), {vpAvoidanceScenes::feasibleMargin, 1e-4});
  const double going = timeOf(truth.scene().arm(), start, goal);
  double freeSince = 0.; // of the whole path
  for (double t = 0.; t < longest; t += step) {
    truth.place(t);
    if (!vpSceneDraw::isFree(truth.scene(), start, vpAvoidanceScenes::feasibleMargin)) {
      return false;
    }
    freeSince = motion.check(start, goal, scratch).isFree() ? freeSince : t + step;
    if (t - freeSince > going + 1.) { // it could have moved by then
      return true;
    }
  }
  return false;
}

//! True if an arm that moves at once is hit on its path, not at its start.
bool isInTheWay(vpTrueScene &truth, const Blind &blind)
{
  for (double t = 0.; t < blind.duration; t += step) {
    truth.place(t);
    if (!vpSceneDraw::isFree(truth.scene(), blind.at(t / blind.duration), 0.)) {
      return t > 0.2 * blind.duration;
    }
  }
  return false;
}

//! True if the path is free without obstacles.
bool isFreeAlone(const vpCollisionScene &empty, const Blind &blind)
{
  return std::all_of(blind.way.begin(), blind.way.end(), [&](const vpJointVector &q) {
    return vpSceneDraw::isFree(empty, q, vpAvoidanceScenes::feasibleMargin);
  });
}

constexpr vpFieldCheck fields("the crossing obstacles");
} // namespace

vpAvoidanceScenario vpAvoidanceScenes::crossing(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed,
                                                const vpCrossingSpec &spec)
{
  vpSceneDraw::requireArm(arm);
  fields.positive("speed", spec.speed, "m/s");
  fields.positive("visionRate", spec.visionRate, "Hz");
  const vpSceneFrame frame = vpSceneFrame::of(*arm);
  for (int draw = 0; draw < vpSceneDraw::mostDraws; ++draw) {
    vpHashRandom random = vpSceneDraw::random(crossingNumber, seed, draw);
    const vpJointVector start = vpSceneDraw::configuration(*arm, random);
    const vpJointVector goal = vpSceneDraw::shortWay(*arm, start, vpSceneDraw::configuration(*arm, random));
    const double way = (vpSceneDraw::tool(*arm, goal) - vpSceneDraw::tool(*arm, start)).norm() / frame.scale;
    vpAvoidanceScenario scenario;
    scenario.run = vpSceneDraw::between(arm, start, goal, seed);
    scenario.run.scene.ground = frame.floor();
    vpMotionScratch scratch;
    const vpCollisionScene empty(*arm, scenario.run.scene);
    if (way < least || way > most ||
        !vpCertifiedMotion(empty, {feasibleMargin, 1e-4}).check(start, goal, scratch).isFree()) {
      continue;
    }
    const Blind joints = alongJoints(*arm, start, goal), line = alongLine(*arm, start, goal);
    if (line.way.empty() || !isFreeAlone(empty, line)) {
      continue;
    }
    scenario.run.obstacles = {randomObstacle(random, 0, *arm, joints, spec.speed),
                              randomObstacle(random, 1, *arm, line, spec.speed)};
    vpTrueScene truth(scenario.run);
    truth.enter(0.);
    if (isInTheWay(truth, joints) && isInTheWay(truth, line) && canWait(truth, start, goal, scenario.run.maxDuration)) {
      scenario.name = "S3 number " + std::to_string(seed);
      scenario.run.visionRate = spec.visionRate;
      scenario.run.latency = spec.latency;
      scenario.run.poses.positionNoise = 0.003;
      scenario.run.poses.viewpoint = Eigen::Vector3d(0., 0., 2.); // a camera above
      scenario.run.poses.range = 5.;
      scenario.run.maxDuration = 30.;
      scenario.draws = draw + 1;
      return scenario;
    }
  }
  vpSceneDraw::giveUp("S3", seed);
}

END_VISP_NAMESPACE
