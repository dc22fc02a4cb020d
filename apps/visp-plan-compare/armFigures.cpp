/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "armFigures.h"

#include "armPicture.h"
#include "numberText.h"

#include <algorithm>
#include <cmath>

namespace planCompare
{
namespace
{
constexpr int GHOSTS = 5;
constexpr std::size_t TRACE_POINTS = 300;
constexpr double FRAME = 0.05;  // s of an animation
constexpr double LONGEST = 20.; // s

std::vector<vpApp::ArmTrace> tracesOf(const Plan &plan, const Results &results, const std::string &scene)
{
  std::vector<vpApp::ArmTrace> traces;
  for (const std::string &method : plan.methods) {
    const vpAvoidanceRun *run = results.find(scene, method);
    if (run == nullptr) {
      continue;
    }
    const MethodInfo info = methodInfo(method);
    vpApp::ArmTrace trace;
    trace.label = info.name;
    trace.colour = info.colour;
    const std::size_t stride = std::max<std::size_t>(1, run->samples.size() / TRACE_POINTS);
    for (std::size_t i = 0; i < run->samples.size(); i += stride) {
      trace.points.push_back(run->samples[i].tool);
    }
    trace.points.push_back(run->samples.back().tool);
    traces.push_back(trace);
  }
  return traces;
}

std::vector<vpApp::ArmMark> marksOf(const vpAvoidanceRun &run)
{
  return {{run.samples.front().tool, "start"}, {run.samples.back().goal, "goal"}};
}

vpCollisionObject objectAt(const vpMovingObstacle &obstacle, double t)
{
  vpCollisionObject object = obstacle.object;
  obstacle.stateAt(t, object.pose, object.velocity);
  return object;
}

//! When the arm has gone so much of its way.
const vpAvoidanceSample &sampleAt(const vpAvoidanceRun &run, double share)
{
  double length = 0.;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    length += (run.samples[i].tool - run.samples[i - 1].tool).norm();
  }
  double gone = 0.;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    gone += (run.samples[i].tool - run.samples[i - 1].tool).norm();
    if (gone >= share * length) {
      return run.samples[i];
    }
  }
  return run.samples.back();
}

//! Which of the scene's runs is shown: "right to left, seed 1".
std::string whichRun(const Plan &plan, const std::string &scene)
{
  for (const Problem &problem : plan.problems) {
    if (problem.scene == scene && problem.shown) {
      return (problem.variant.empty() ? "" : problem.variant + ", ") + "seed " + std::to_string(problem.seed);
    }
  }
  return "";
}

void addGhosts(const vpAvoidanceRun &run, vpApp::ArmPicture &picture)
{
  for (int i = 0; i < GHOSTS; ++i) {
    const double share = static_cast<double>(i) / (GHOSTS - 1);
    const vpAvoidanceSample &s = i == 0 ? run.samples.front() : sampleAt(run, share);
    picture.ghosts.push_back({s.q,
                              i == 0            ? "#8d99ae"
                              : i == GHOSTS - 1 ? "#1d3557"
                                                : "#5c7c9c",
                              i == 0 || i == GHOSTS - 1 ? 0.55 : 0.16});
  }
}
} // namespace

Figure drawArm(const Plan &plan, const Results &results, const SceneInfo &scene)
{
  const std::string hero = heroOf(plan, results, scene.id);
  const vpAvoidanceRun &run = *results.find(scene.id, hero);
  vpApp::ArmPicture picture;
  picture.title = scene.id + " " + scene.name + ", " + whichRun(plan, scene.id) + ": arm of " + methodInfo(hero).name;
  picture.ground = run.spec.scene.ground.has_value();
  picture.objects = run.spec.scene.objects;
  const double middle = sampleAt(run, 0.5).time;
  for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
    picture.objects.push_back(objectAt(obstacle, std::max(middle, obstacle.appears)));
    if (obstacle.object.velocity.linearNorm() > 0.) {
      picture.faint.push_back(objectAt(obstacle, std::max(0., middle - 1.)));
    }
  }
  addGhosts(run, picture);
  picture.traces = tracesOf(plan, results, scene.id);
  picture.marks = marksOf(run);
  Figure figure;
  figure.scene = scene.id;
  figure.name = scene.id + "-arm";
  figure.title = picture.title;
  figure.caption =
      "Lines: the ways of all methods' tools. The arm is drawn at the start (grey), at the end (dark) and in "
      "between (faint) for " +
      methodInfo(hero).name + ", which has the most successes here" +
      (run.spec.obstacles.empty() ? "."
                                  : "; moving obstacles where they are when it is half way, and a second "
                                    "before (dashed).");
  figure.svg = vpApp::armPictureSvg(*plan.arm, picture);
  return figure;
}

Figure animateArm(const Plan &plan, const Results &results, const SceneInfo &scene)
{
  const std::string hero = heroOf(plan, results, scene.id);
  const vpAvoidanceRun &run = *results.find(scene.id, hero);
  vpApp::ArmAnimation animation;
  animation.title = scene.id + " " + scene.name + ", " + whichRun(plan, scene.id) + ": " + methodInfo(hero).name;
  animation.ground = run.spec.scene.ground.has_value();
  animation.still = run.spec.scene.objects;
  for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
    animation.objects.push_back(obstacle.object);
  }
  animation.marks = marksOf(run);
  double next = 0.;
  for (const vpAvoidanceSample &s : run.samples) {
    if (s.time < next - 1e-9 || s.time > LONGEST) {
      continue;
    }
    next = s.time + FRAME;
    vpApp::ArmFrame frame;
    frame.time = s.time;
    frame.q = s.q;
    for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
      frame.objects.push_back(objectAt(obstacle, s.time).pose);
      frame.visible.push_back(obstacle.isThere(s.time));
    }
    frame.caption = std::string(s.stopping ? "protective stop, " : "") + toString(s.status);
    animation.frames.push_back(frame);
  }
  Figure figure;
  figure.scene = scene.id;
  figure.name = scene.id + "-animation";
  figure.title = animation.title;
  figure.caption = "The same run as an animation: press Play or move the slider.";
  std::string id = "anim";
  for (const char c : vpApp::fileName(scene.id)) {
    id += std::isalnum(static_cast<unsigned char>(c)) ? c : 'x';
  }
  figure.html = vpApp::armAnimationHtml(*plan.arm, animation, id);
  return figure;
}
} // namespace planCompare
