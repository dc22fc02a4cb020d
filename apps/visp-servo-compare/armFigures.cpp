/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "armFigures.h"

#include "catalogue.h"
#include "format.h"
#include "plot.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace servoCompare
{
namespace
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

constexpr std::size_t CURVE_POINTS = 600; // more would not be visible
constexpr const char *DEFAULT_LAW = "ff-lookat-pi";
const char *const JOINT_COLOURS[] = {"#1f77b4", "#ff7f0e", "#2ca02c", "#d62728",
                                     "#9467bd", "#8c564b", "#e377c2", "#7f7f7f"};

using Value = std::function<double(const vpArmSample &)>;

PlotCurve curveOf(const vpServoRun &run, const std::string &label, const std::string &colour, const Value &value)
{
  PlotCurve curve;
  curve.label = label;
  curve.colour = colour;
  const std::size_t stride = std::max<std::size_t>(1, run.arm.size() / CURVE_POINTS);
  for (std::size_t i = 0; i < run.arm.size(); i += stride) {
    curve.x.push_back(run.samples[i].time);
    curve.y.push_back(value(run.arm[i]));
  }
  return curve;
}

//! A plot with one curve per applicable joint.
Plot jointPlot(const vpArmModel &model, const vpServoRun &run, const std::string &title, const std::string &unit,
               const std::function<bool(int)> &shown, const std::function<double(const vpArmSample &, int)> &value)
{
  Plot plot;
  plot.title = title;
  plot.xLabel = "time (s)";
  plot.yLabel = unit;
  plot.height = 300;
  for (int i = 0; i < model.size(); ++i) {
    if (shown(i)) {
      plot.curves.push_back(curveOf(run, model.spec().joints[static_cast<std::size_t>(i)].name, JOINT_COLOURS[i],
                                    [&value, i](const vpArmSample &s) { return value(s, i); }));
    }
  }
  return plot;
}

Plot selfMotionPlot(const vpServoRun &run)
{
  Plot plot;
  plot.title = "Self-motion and manipulability";
  plot.xLabel = "time (s)";
  plot.yLabel = "rad/s; manipulability x 10";
  plot.height = 300;
  plot.fromZero = true;
  plot.curves.push_back(
      curveOf(run, "self-motion (rad/s)", "#1f77b4", [](const vpArmSample &s) { return s.selfMotion; }));
  plot.curves.push_back(
      curveOf(run, "manipulability x 10", "#d62728", [](const vpArmSample &s) { return 10. * s.manipulability; }));
  return plot;
}

Figure jointsFigure(const Plan &plan, const vpServoRun &run, const std::string &where)
{
  const vpArmModel &model = plan.arm->model;
  const auto all = [](int) { return true; };
  const auto limited = [&model](int i) { return !model.isContinuous(i); };
  const auto size = [&model](int i, double q) { return model.isPrismatic(i) ? 1000. * q : vpMath::deg(q); };
  std::vector<Plot> panels;
  panels.push_back(jointPlot(model, run, "Joints, " + where, "deg (mm)", all,
                             [&](const vpArmSample &s, int i) { return size(i, s.q(i)); }));
  panels.push_back(jointPlot(model, run, "Commanded speed as a part of its limit", "%", all,
                             [&](const vpArmSample &s, int i) { return 100. * s.command(i) / model.velocity()(i); }));
  Plot margins =
      jointPlot(model, run, "Room to the nearer position limit", "deg (mm)", limited, [&](const vpArmSample &s, int i) {
        return size(i, std::min(s.q(i) - model.lower()(i), model.upper()(i) - s.q(i)));
      });
  margins.fromZero = true;
  if (!margins.curves.empty()) {
    panels.push_back(margins);
  }
  panels.push_back(selfMotionPlot(run));
  return {
      "arm-joints", vpApp::renderPanels(panels, vpApp::PlotFormat::Svg), "The joints on plant " + run.spec.plant.name,
      where + ". From top to bottom: the joints; how much of their speed limits they use; how far the limited ones are "
              "from their nearer limit; self-motion, which turns joints without moving the camera, and the "
              "manipulability sqrt(det(J J^T)), 0 in a singularity."};
}

Figure errorFigure(const Plan &plan, const vpServoRun &run, const std::string &where)
{
  const vpArmModel &model = plan.arm->model;
  Plot plot = jointPlot(
      model, run, "Joint errors, " + where, "mrad (mm)", [](int) { return true; },
      [](const vpArmSample &s, int i) { return 1000. * (s.wanted(i) - s.q(i)); });
  plot.height = 400;
  return {"arm-errors", vpApp::renderSvg(plot), "Joint errors on plant " + run.spec.plant.name,
          where +
              ": commanded minus true joints. PD control with gravity; a joint that sticks keeps an error up to its "
              "friction over its gain."};
}
} // namespace

std::string armLaw(const Plan &plan)
{
  const bool run = std::find(plan.laws.begin(), plan.laws.end(), DEFAULT_LAW) != plan.laws.end();
  return run ? DEFAULT_LAW : plan.laws.front();
}

std::vector<Figure> drawArmFigures(const Plan &plan, const Results &results)
{
  std::vector<Figure> figures;
  const std::string law = armLaw(plan);
  const vpServoRun *run = results.find(law, plan.hardPlant().name, plan.mainMeasure());
  if (run == nullptr || run->arm.empty()) {
    return figures;
  }
  const std::string where = lawInfo(law).name + " on plant " + run->spec.plant.name;
  figures.push_back(jointsFigure(plan, *run, where));
  if (run->armMetrics->joint_rms.maxCoeff() > 0.) {
    figures.push_back(errorFigure(plan, *run, where));
  }
  return figures;
}
} // namespace servoCompare
