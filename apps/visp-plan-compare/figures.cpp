/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "figures.h"

#include "jobs.h"
#include "numberText.h"
#include "runPicture.h"
#include "timePlot.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cmath>

namespace planCompare
{
namespace
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

constexpr double CUT = 3.; // in units of the bound of a: larger values are drawn there

using Value = std::function<double(const vpAvoidanceRun &, std::size_t)>;

Eigen::Vector3d velocityAt(const vpAvoidanceRun &run, std::size_t i)
{
  if (i == 0 || i >= run.samples.size()) {
    return Eigen::Vector3d::Zero();
  }
  const vpAvoidanceSample &a = run.samples[i - 1], &b = run.samples[i];
  return (b.tool - a.tool) / std::max(b.time - a.time, 1e-9);
}

double speed(const vpAvoidanceRun &run, std::size_t i) { return velocityAt(run, i).norm(); }

double acceleration(const vpAvoidanceRun &run, std::size_t i)
{
  const double a = (velocityAt(run, i) - velocityAt(run, i == 0 ? 0 : i - 1)).norm() / run.spec.methodSpec.period;
  return std::min(a, CUT * run.spec.methodSpec.maxAcceleration);
}

double goalDistance(const vpAvoidanceRun &run, std::size_t i) { return 1000. * run.samples[i].goalDistance; }

double clearance(const vpAvoidanceRun &run, std::size_t i)
{
  return 1000. * std::min(0.3, run.samples[i].clearance.distance);
}

//! A value over time, one curve per method.
Plot methodsOverTime(const Plan &plan, const Results &results, const std::string &scene, const std::string &title,
                     const std::string &label, const Value &value, vpApp::Keep keep = vpApp::Keep::Largest)
{
  Plot plot = vpApp::timePlot(title, label, 300);
  for (const std::string &method : plan.methods) {
    if (const vpAvoidanceRun *run = results.find(scene, method)) {
      const MethodInfo info = methodInfo(method);
      plot.curves.push_back(vpApp::timeCurve(
          info.name, info.colour, run->samples.size(), [&](std::size_t i) { return run->samples[i].time; },
          [&](std::size_t i) { return value(*run, i); }, keep));
    }
  }
  return plot;
}

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

//! Tool paths of all methods, and the arm of one of them at some times.
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

//! Animation of that arm and the obstacles.
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

Figure drawTimes(const Plan &plan, const Results &results, const SceneInfo &scene)
{
  const vpAvoidanceMethodSpec limits = results.find(scene.id, plan.methods.front())->spec.methodSpec;
  std::vector<Plot> panels;
  panels.push_back(methodsOverTime(plan, results, scene.id, "Speed of the tool", "m/s", speed));
  vpApp::addLevel(panels.back(), limits.maxVelocity, "bound");
  panels.push_back(methodsOverTime(plan, results, scene.id, "Acceleration of the tool", "m/s^2", acceleration));
  vpApp::addLevel(panels.back(), limits.maxAcceleration, "bound");
  panels.push_back(methodsOverTime(plan, results, scene.id, "Least clearance", "mm", clearance, vpApp::Keep::Least));
  vpApp::addLevel(panels.back(), 0., "touching");
  panels.push_back(methodsOverTime(plan, results, scene.id, "Distance from the goal", "mm", goalDistance));
  Figure figure;
  figure.scene = scene.id;
  figure.name = scene.id + "-times";
  figure.title = scene.id + ": speed, acceleration, clearance and distance from the goal";
  figure.caption =
      "The first run of every method. Accelerations above three times the bound are drawn there, clearances "
      "above 300 mm, too; the clearance is the least of all pairs of parts that must not touch, the arm's own "
      "among them.";
  figure.svg = vpApp::renderPanels(panels, vpApp::PlotFormat::Svg);
  return figure;
}

Figure drawSelfMotion(const std::vector<SelfMotionRow> &rows)
{
  std::vector<Plot> panels;
  const std::vector<std::pair<std::string, std::string>> shades = {
      {"attract", "#d62728"}, {"none", "#555555"}, {"repel", "#1f77b4"}};
  for (const char *index : {"point", "line", "plane"}) {
    Plot plot = vpApp::timePlot(std::string("Distance of joint 4 from the ") + index, "mm", 280);
    for (const SelfMotionRow &row : rows) {
      if (row.index != index) {
        continue;
      }
      PlotCurve curve;
      curve.label = row.share > 0. ? row.sense + " " + std::to_string(row.share).substr(0, 3) : "no self-motion";
      for (const auto &[sense, colour] : shades) {
        curve.colour = sense == row.sense ? colour : curve.colour;
      }
      curve.style = row.share > 0. && row.share < 0.5 ? PlotStyle::Dashed : PlotStyle::Solid;
      for (std::size_t i = 0; i < row.run.samples.size(); i += 4) {
        curve.x.push_back(row.run.samples[i].time);
        curve.y.push_back(1000. * row.run.samples[i].distance);
      }
      plot.curves.push_back(curve);
    }
    panels.push_back(plot);
  }
  Figure figure;
  figure.scene = "S5";
  figure.name = "S5-distances";
  figure.title = "S5: distance of joint 4 from a point, a line and a plane, figures 8.14 to 8.17";
  figure.caption =
      "Repulsion raises the distance and attraction lowers it, while the tool goes through the same places.";
  figure.svg = vpApp::renderPanels(panels, vpApp::PlotFormat::Svg);
  return figure;
}
} // namespace

std::string heroOf(const Plan &plan, const Results &results, const std::string &scene)
{
  std::string best = plan.methods.front();
  int most = -1;
  double shortest = 0.;
  for (const std::string &method : plan.methods) {
    const Cell cell = results.cell(scene, method);
    const double duration = vpMedian(cell.values(&vpAvoidanceMetrics::duration_s, true));
    if (cell.successes() > most || (cell.successes() == most && duration < shortest)) {
      best = method;
      most = cell.successes();
      shortest = duration;
    }
  }
  return best;
}

std::vector<Figure> drawFigures(const Plan &plan, const Results &results, const std::vector<SelfMotionRow> &selfMotion,
                                unsigned int jobs)
{
  std::vector<std::function<Figure()>> drafts;
  for (const SceneInfo &scene : plan.scenes) {
    drafts.emplace_back([&] { return drawArm(plan, results, scene); });
    drafts.emplace_back([&] { return animateArm(plan, results, scene); });
    drafts.emplace_back([&] { return drawTimes(plan, results, scene); });
  }
  if (!selfMotion.empty()) {
    drafts.emplace_back([&] { return drawSelfMotion(selfMotion); });
  }
  std::vector<Figure> figures(drafts.size());
  vpApp::runJobs(drafts.size(), jobs, [&](std::size_t i) { figures[i] = drafts[i](); });
  return figures;
}
} // namespace planCompare
