/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "armFigures.h"

#include "numberText.h"
#include "runPicture.h"

#include <algorithm>
#include <cmath>

namespace planCompare
{
namespace
{
std::vector<vpApp::ArmTrace> tracesOf(const Plan &plan, const Results &results, const std::string &scene)
{
  std::vector<vpApp::ArmTrace> traces;
  for (const std::string &method : plan.methods) {
    const vpAvoidanceRun *run = results.find(scene, method);
    if (run == nullptr) {
      continue;
    }
    const MethodInfo info = methodInfo(method);
    traces.push_back(vpApp::toolTrace(*run, info.name, info.colour));
  }
  return traces;
}

//! Description of the shown run of a scene: "right to left, seed 1".
std::string whichRun(const Plan &plan, const std::string &scene)
{
  for (const Problem &problem : plan.problems) {
    if (problem.scene == scene && problem.shown) {
      return (problem.variant.empty() ? "" : problem.variant + ", ") + "seed " + std::to_string(problem.seed);
    }
  }
  return "";
}
} // namespace

Figure drawArm(const Plan &plan, const Results &results, const SceneInfo &scene)
{
  const std::string hero = heroOf(plan, results, scene.id);
  const vpAvoidanceRun &run = *results.find(scene.id, hero);
  vpApp::ArmPicture picture = vpApp::runPicture(run, scene.id + " " + scene.name + ", " + whichRun(plan, scene.id) +
                                                         ": arm of " + methodInfo(hero).name);
  const double middle = vpApp::sampleAt(run, 0.5).time;
  for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
    if (obstacle.object.velocity.linearNorm() > 0.) {
      picture.faint.push_back(vpApp::objectAt(obstacle, std::max(0., middle - 1.)));
    }
  }
  picture.traces = tracesOf(plan, results, scene.id);
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
  const vpApp::ArmAnimation animation = vpApp::runAnimation(
      run, scene.id + " " + scene.name + ", " + whichRun(plan, scene.id) + ": " + methodInfo(hero).name);
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
