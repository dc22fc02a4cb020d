/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpSceneDraw.h"

#include "lab/avoidance/vpReachPoint.h"

#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

vpHashRandom vpSceneDraw::random(unsigned int scene, unsigned int seed, int draw)
{
  return {seed, vpHashRandom::Purpose::Scene, scene, draw};
}

void vpSceneDraw::requireArm(const std::shared_ptr<const vpArmModel> &arm)
{
  if (!arm) {
    throw vpException(vpException::badValue, "the scene has no arm");
  }
}

void vpSceneDraw::giveUp(const char *scene, unsigned int seed)
{
  throw vpException(vpException::badValue,
                    "scene %s with seed %u: none of %d draws meets the conditions, is the arm "
                    "of AMOR's size?",
                    scene, seed, mostDraws);
}

vpHalfSpace vpSceneDraw::ground()
{
  vpHalfSpace plane;
  plane.firstLink = 3;
  return plane;
}

vpAvoidanceRunSpec vpSceneDraw::between(const std::shared_ptr<const vpArmModel> &arm, const vpJointVector &start,
                                        const vpJointVector &goal, unsigned int seed)
{
  vpAvoidanceRunSpec run;
  run.arm = arm;
  run.start = start;
  run.goal = vpAvoidanceGoal::at(*arm, goal);
  run.seed = seed;
  run.methodSpec.seed = std::max(1U, seed);
  return run;
}

vpJointVector vpSceneDraw::configuration(const vpArmModel &arm, vpHashRandom &random)
{
  constexpr double away = 0.05;
  vpJointVector q(arm.size());
  for (int i = 0; i < arm.size(); ++i) {
    const double lower = arm.isContinuous(i) ? -M_PI : arm.lower()(i);
    const double range = arm.isContinuous(i) ? 2. * M_PI : arm.upper()(i) - lower;
    q(i) = lower + range * (arm.isContinuous(i) ? random.uniform() : random.uniform(away, 1. - away));
  }
  return q;
}

vpJointVector vpSceneDraw::shortWay(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal)
{
  vpJointVector near = goal;
  for (int i = 0; i < arm.size(); ++i) {
    near(i) = arm.isContinuous(i) ? start(i) + std::remainder(goal(i) - start(i), 2. * M_PI) : goal(i);
  }
  return near;
}

Eigen::Vector3d vpSceneDraw::direction(vpHashRandom &random)
{
  const double z = random.uniform(-1., 1.), angle = random.uniform(-M_PI, M_PI), r = std::sqrt(1. - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Eigen::Vector3d vpSceneDraw::tool(const vpArmModel &arm, const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::forward(arm, q, data);
  return data.tool.p;
}

bool vpSceneDraw::isFree(const vpCollisionScene &scene, const vpJointVector &q, double margin)
{
  vpCollisionData data;
  scene.place(q, data);
  return !scene.inCollision(data, margin);
}

std::vector<vpJointVector> vpSceneDraw::toolLine(const vpArmModel &arm, const vpJointVector &start,
                                                 const vpJointVector &goal, int count)
{
  const Eigen::Vector3d from = tool(arm, start), way = tool(arm, goal) - from;
  std::vector<vpJointVector> line = {start};
  for (int i = 1; i < count; ++i) {
    vpJointVector q = line.back();
    if (!vpReachPoint(arm, from + static_cast<double>(i) / (count - 1) * way, q)) {
      return {};
    }
    line.push_back(q);
  }
  return line;
}

bool vpSceneDraw::hasPath(const vpCollisionScene &scene, const vpJointVector &start, const vpJointVector &goal,
                          unsigned int seed)
{
  vpPathPlannerSpec spec;
  spec.margin = vpAvoidanceScenes::feasibleMargin;
  spec.iterations = 2000;
  spec.timeLimit = 1000.; // never reached: a scene must not depend on the speed of the machine
  spec.shortenTime = 0.;
  spec.seed = std::max(1U, seed);
  return vpPathPlanner(scene, spec).plan(start, goal).status == vpPathStatus::Solved;
}

END_VISP_NAMESPACE
