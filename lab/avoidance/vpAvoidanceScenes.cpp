/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpAvoidanceScenes.h"

#include "lab/avoidance/vpSceneDraw.h"
#include "lab/avoidance/vpTrueScene.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <algorithm>
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
  throw vpException(vpException::badValue, "scene %s with seed %u: none of %d draws meets the conditions for this arm",
                    scene, seed, mostDraws);
}

vpAvoidanceRunSpec vpSceneDraw::between(const std::shared_ptr<const vpArmModel> &arm, const vpJointVector &start,
                                        const vpJointVector &goal, unsigned int seed)
{
  vpAvoidanceRunSpec run;
  run.arm = arm;
  run.scene = vpIgnoreUncovered(*arm);
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
    if (!arm.isPrismatic(i) && range > 2. * M_PI) { // a turn about the middle
      q(i) = lower + 0.5 * range + random.uniform(-M_PI, M_PI);
      continue;
    }
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

namespace
{
constexpr unsigned int number = 1;

/*!
 * \brief Start of the arm, and the plane of chapter 8 there. The thesis's start and directions if the arm is free and
 * reaches all goals there; else the first of random ones.
 */
struct Stage {
  vpJointVector start;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); // tool at the start
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  double scale = 1.;

  [[nodiscard]] Eigen::Vector3d way(double x, double y) const
  {
    return axes * Eigen::Vector3d(scale * x, scale * y, 0.);
  }
  [[nodiscard]] Eigen::Vector3d place(double x, double y) const { return origin + way(x, y); }
  //! The nearby configuration with the tool at a place of the plane; false if there is none.
  [[nodiscard]] bool reach(const vpArmModel &arm, double x, double y, vpJointVector &q) const
  {
    q = start;
    return vpReachPoint(arm, place(x, y), q);
  }
  [[nodiscard]] vpAvoidanceGoal goal(const vpArmModel &arm, double x, double y) const
  {
    vpJointVector q;
    static_cast<void>(reach(arm, x, y, q)); // isUsable() has tried it
    return vpAvoidanceGoal::at(arm, q);
  }
};

using Goals = std::vector<std::pair<double, double>>;

bool isUsable(const vpCollisionScene &scene, const Stage &stage, const Goals &goals)
{
  vpJointVector q;
  return vpSceneDraw::isFree(scene, stage.start, vpAvoidanceScenes::feasibleMargin) &&
         std::all_of(goals.begin(), goals.end(), [&](const auto &goal) {
           return stage.reach(scene.arm(), goal.first, goal.second, q) &&
                  vpSceneDraw::isFree(scene, q, vpAvoidanceScenes::feasibleMargin);
         });
}

Stage findStage(const vpArmModel &arm, const char *scene, unsigned int scenes, const Goals &goals)
{
  const vpSceneFrame frame = vpSceneFrame::of(arm);
  vpCollisionSceneSpec spec = vpIgnoreUncovered(arm);
  spec.ground = frame.floor();
  const vpCollisionScene alone(arm, spec);
  Stage stage;
  stage.scale = frame.scale;
  for (int draw = -1; draw < vpSceneDraw::mostDraws; ++draw) {
    vpHashRandom random = vpSceneDraw::random(scenes, 0, draw);
    double ahead = 0.63, above = 0.35;
    stage.start = arm.home();
    if (draw >= 0) {
      stage.start = vpSceneDraw::configuration(arm, random);
      stage.axes = vpSO3::exp(random.uniform(-M_PI, M_PI) * Eigen::Vector3d::UnitZ());
      ahead = random.uniform(0.25, 0.63);
      above = random.uniform(0.15, 0.6);
    }
    const Eigen::Vector3d place = frame.place(stage.axes * Eigen::Vector3d(0.05, ahead, above));
    const bool reached = vpReachPoint(arm, place, stage.start);
    stage.origin = vpSceneDraw::tool(arm, stage.start);
    if (reached && isUsable(alone, stage, goals)) {
      return stage;
    }
  }
  throw vpException(vpException::badValue, "scene %s: arm %s is free and reaches all goals from none of %d starts",
                    scene, arm.label().c_str(), vpSceneDraw::mostDraws);
}

//! Fraction of a path after which an arm can be at rest: it starts with minimum jerk and 1 m/s^2 and sees at \e t.
double goneUntil(double t, double way)
{
  constexpr double braking = 0.06; // m
  const double s = std::min(1., t / std::sqrt(10. / std::sqrt(3.) * way));
  return s * s * s * (10. - 15. * s + 6. * s * s) + braking / way;
}

//! True if the ball touches the tool on the straight path, but neither at its start nor at the new goal.
bool isGood(const vpCollisionScene &scene, const vpJointVector &start, const Eigen::Vector3d &way,
            const vpJointVector &goal, double from, unsigned int seed)
{
  if (!vpSceneDraw::isFree(scene, start, vpAvoidanceScenes::feasibleMargin) ||
      !vpSceneDraw::isFree(scene, goal, vpAvoidanceScenes::feasibleMargin)) {
    return false;
  }
  vpJointVector q = start;
  const Eigen::Vector3d place = vpSceneDraw::tool(scene.arm(), start);
  bool touched = false;
  for (double s = 0.; s <= 1.; s += 0.02) {
    const bool reached = vpReachPoint(scene.arm(), place + s * way, q);
    const bool free = vpSceneDraw::isFree(scene, q, 0.);
    if (!reached || (s <= from && !vpSceneDraw::isFree(scene, q, vpAvoidanceScenes::feasibleMargin))) {
      return false; // too near to where the arm is when it appears
    }
    touched = touched || !free;
  }
  return touched && vpSceneDraw::hasPath(scene, start, goal, seed);
}
} // namespace

vpAvoidanceScenario vpAvoidanceScenes::figure88(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed)
{
  vpSceneDraw::requireArm(arm);
  const Stage stage = findStage(*arm, "S1", number, {{0., 0.3}, {0.175, 0.3}});
  const vpAvoidanceGoal straight = stage.goal(*arm, 0., 0.3), aside = stage.goal(*arm, 0.175, 0.3);
  const Eigen::Vector3d way = stage.way(0., 0.3);
  for (int draw = 0; draw < vpSceneDraw::mostDraws; ++draw) {
    vpHashRandom random = vpSceneDraw::random(number, seed, draw);
    const double when = random.uniform(0.2, 0.45);
    vpMovingObstacle ball;
    ball.object.name = "ball";
    ball.object.shape = vpCollisionShape::sphere(stage.scale * 0.05);
    const Eigen::Vector3d p(random.uniform(-0.1, 0.05), random.uniform(0.15, 0.35), random.uniform(-0.05, 0.05));
    ball.object.pose.p = stage.place(p.x(), p.y());
    ball.object.pose.p.z() += stage.scale * p.z();
    ball.appears = when;
    vpAvoidanceScenario scenario;
    scenario.run = vpSceneDraw::between(arm, stage.start, straight.q, seed);
    scenario.run.scene.ground = vpSceneFrame::of(*arm).floor();
    vpCollisionScene scene(*arm, scenario.run.scene);
    scene.add(ball.object);
    if (isGood(scene, stage.start, way, aside.q, goneUntil(when + 0.15, way.norm()), seed)) {
      scenario.name = "S1 number " + std::to_string(seed);
      scenario.run.obstacles.push_back(ball);
      scenario.run.goalMoves = {{when, when, aside}};
      scenario.run.visionRate = 10.;
      scenario.run.poses.viewpoint = Eigen::Vector3d(0., 0., 2.); // a camera above
      scenario.run.poses.range = 5.;
      scenario.draws = draw + 1;
      return scenario;
    }
  }
  vpSceneDraw::giveUp("S1", seed);
}

vpAvoidanceScenario vpAvoidanceScenes::movingGoal(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed)
{
  constexpr unsigned int movingNumber = 7;
  vpSceneDraw::requireArm(arm);
  const Stage stage = findStage(*arm, "S7", movingNumber, {{0.1, 0.3}, {0.23, 0.13}, {0.14, 0.04}});
  vpAvoidanceScenario scenario;
  scenario.name = "S7 number " + std::to_string(seed);
  scenario.run = vpSceneDraw::between(arm, stage.start, stage.goal(*arm, 0.1, 0.3).q, seed);
  scenario.run.goalMoves = {{0.5, 0.9, stage.goal(*arm, 0.23, 0.13)}, {1.7, 1.9, stage.goal(*arm, 0.14, 0.04)}};
  scenario.run.goalNoise = 0.01;
  scenario.run.maxDuration = 10.;
  return scenario;
}

vpAvoidanceScenario vpAvoidanceScenes::fromTask(const std::shared_ptr<const vpArmModel> &arm,
                                                const vpCollisionSceneFile &file, std::size_t task, unsigned int seed)
{
  vpSceneDraw::requireArm(arm);
  if (task >= file.tasks.size()) {
    throw vpException(vpException::badValue, "scene %s has %d tasks, there is no number %d", file.name.c_str(),
                      static_cast<int>(file.tasks.size()), static_cast<int>(task));
  }
  const vpMotionTask &motion = file.tasks[task];
  if (motion.start.size() != arm->size() || motion.goal.size() != arm->size()) {
    throw vpException(vpException::badValue, "task %s of scene %s is for %d joints, arm %s has %d", motion.name.c_str(),
                      file.name.c_str(), static_cast<int>(motion.start.size()), arm->label().c_str(), arm->size());
  }
  vpAvoidanceScenario scenario;
  scenario.name = file.name + ", " + motion.name;
  scenario.run = vpSceneDraw::between(arm, motion.start, motion.goal, seed);
  scenario.run.scene = vpIgnoreUncovered(*arm, file.spec);
  scenario.run.visionRate = 5.;
  return scenario;
}

END_VISP_NAMESPACE
