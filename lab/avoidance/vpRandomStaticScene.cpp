/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpSceneDraw.h"

#include <visp3/direct_core/vpSO3.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr unsigned int number = 2;

vpCollisionShape randomShape(vpHashRandom &random)
{
  const auto kind = static_cast<int>(random.uniform(0., 4.));
  const double radius = random.uniform(0.03, 0.12), length = random.uniform(0.06, 0.6);
  const Eigen::Vector3d size(random.uniform(0.06, 0.4), random.uniform(0.06, 0.4), random.uniform(0.06, 0.4));
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

vpCollisionSceneSpec randomScene(vpHashRandom &random)
{
  vpCollisionSceneSpec spec;
  spec.ground = vpSceneDraw::ground();
  const int count = 3 + static_cast<int>(random.uniform(0., 8.));
  for (int i = 0; i < count; ++i) {
    vpCollisionObject object;
    object.name = "obstacle " + std::to_string(i + 1);
    object.shape = randomShape(random);
    object.pose.p = randomPlace(random);
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
bool isGood(const vpCollisionScene &scene, const vpJointVector &start, const vpJointVector &goal, unsigned int seed)
{
  constexpr double least = 0.3, most = 0.8; // m, distance of the tool positions
  const vpArmModel &arm = scene.arm();
  const double way = (vpSceneDraw::tool(arm, goal) - vpSceneDraw::tool(arm, start)).norm();
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
  for (int draw = 0; draw < vpSceneDraw::mostDraws; ++draw) {
    vpHashRandom random = vpSceneDraw::random(number, seed, draw);
    const vpCollisionSceneSpec spec = randomScene(random);
    const vpJointVector start = vpSceneDraw::configuration(*arm, random);
    const vpJointVector goal = vpSceneDraw::shortWay(*arm, start, vpSceneDraw::configuration(*arm, random));
    if (isGood(vpCollisionScene(*arm, spec), start, goal, seed)) {
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

END_VISP_NAMESPACE
