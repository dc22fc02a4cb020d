/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figures of the run of one law: the joints, and the first second raw and shaped.
#include "figures.h"

#include "catalogue.h"
#include "format.h"
#include "timePlot.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>

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
  Plot plot = vpApp::timePlot(title, unit, 300);
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
  Plot plot = vpApp::timePlot("Self-motion and manipulability", "rad/s; manipulability x 10", 300);
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

constexpr double BEFORE = 0.1;   // s shown before the start of the command
constexpr double AFTER = 1.;     // s shown after the start
constexpr double HEADROOM = 2.5; // range of the acceleration plots in limits; the raw step is far beyond
constexpr const char *RAW = "#d62728";
constexpr const char *SHAPED = "#1f77b4";

//! The linear or the angular part of a twist.
struct Part {
  int first; //!< Index of its first component.
  const char *name;
  const char *speedUnit;
  const char *accelerationUnit;
  double limit; //!< Acceleration limit.
};

double change(const vpTwist &to, const vpTwist &from, const Part &part)
{
  double sum = 0.;
  for (int i = part.first; i < part.first + 3; ++i) {
    const double d = to[static_cast<std::size_t>(i)] - from[static_cast<std::size_t>(i)];
    sum += d * d;
  }
  return std::sqrt(sum);
}

//! Time at which the raw law starts to move the robot, s; later than 0 with latency.
double beginning(const vpServoRun &raw)
{
  for (const vpServoSample &s : raw.samples) {
    if (s.commanded.linearNorm() > 0. || s.commanded.angularNorm() > 0.) {
      return s.time;
    }
  }
  return 0.;
}

//! Restricts the plot to the beginning of a run.
class StepPlots
{
public:
  StepPlots(const vpServoRun &raw, const vpServoRun &shaped)
    : m_raw(raw), m_shaped(shaped), m_cycle(1. / raw.spec.plant.loopRate), m_begin(beginning(raw))
  {}

  [[nodiscard]] Plot speed(const Part &part) const
  {
    Plot plot = empty(std::string(part.name) + " speed that is commanded", part.speedUnit);
    plot.curves = {speedOf(m_raw, part, RAW, "raw"), speedOf(m_shaped, part, SHAPED, "shaped")};
    return plot;
  }

  [[nodiscard]] Plot acceleration(const Part &part) const
  {
    Plot plot = empty(std::string(part.name) + " acceleration that this asks for", part.accelerationUnit);
    plot.curves = {accelerationOf(m_raw, part, RAW, "raw"), accelerationOf(m_shaped, part, SHAPED, "shaped")};
    PlotCurve limit{"limit", "#555555", PlotStyle::Dotted, 2., {plot.xRange.first, plot.xRange.second}, {}};
    limit.y = {part.limit, part.limit};
    plot.curves.push_back(limit);
    plot.height += 70; // room for the label at its top
    const double step = stepOf(m_raw, part);
    if (step > HEADROOM * part.limit) {
      plot.marks = {{m_begin, "raw: up to " + number(step, 3) + " " + part.accelerationUnit + ", far off the scale"}};
    }
    return plot;
  }

  //! Largest acceleration in the displayed time.
  [[nodiscard]] double stepOf(const vpServoRun &run, const Part &part) const
  {
    double largest = 0.;
    vpTwist before;
    for (const vpServoSample &s : run.samples) {
      if (s.time <= m_begin + AFTER) {
        largest = std::max(largest, change(s.commanded, before, part) / m_cycle);
      }
      before = s.commanded;
    }
    return largest;
  }

private:
  [[nodiscard]] Plot empty(const std::string &title, const std::string &unit) const
  {
    Plot plot = vpApp::timePlot(title, unit);
    plot.xRange = {m_begin - BEFORE, m_begin + AFTER};
    plot.fromZero = true;
    return plot;
  }

  // Stairs: the command holds for a cycle.
  [[nodiscard]] PlotCurve speedOf(const vpServoRun &run, const Part &part, const char *colour, const char *label) const
  {
    PlotCurve curve{label, colour, PlotStyle::Solid, 2., {-BEFORE, 0.}, {0., 0.}};
    for (const vpServoSample &s : run.samples) {
      if (s.time <= m_begin + AFTER) {
        curve.x.insert(curve.x.end(), {s.time, s.time + m_cycle});
        const double speed = change(s.commanded, vpTwist(), part);
        curve.y.insert(curve.y.end(), {speed, speed});
      }
    }
    return curve;
  }

  [[nodiscard]] PlotCurve accelerationOf(const vpServoRun &run, const Part &part, const char *colour,
                                         const char *label) const
  {
    PlotCurve curve{label, colour, PlotStyle::Solid, 2., {-BEFORE, -m_cycle}, {0., 0.}};
    vpTwist before;
    for (const vpServoSample &s : run.samples) {
      if (s.time <= m_begin + AFTER) {
        curve.x.push_back(s.time);
        curve.y.push_back(std::min(change(s.commanded, before, part) / m_cycle, HEADROOM * part.limit));
      }
      before = s.commanded;
    }
    return curve;
  }

  const vpServoRun &m_raw;
  const vpServoRun &m_shaped;
  double m_cycle; // s
  double m_begin; // s
};
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

Figure drawStep(const Plan &plan, const Results &results)
{
  const bool hasPbvs = std::find(plan.laws.begin(), plan.laws.end(), "pbvs1") != plan.laws.end();
  const std::string law = hasPbvs ? "pbvs1" : plan.laws.front();
  const vpServoPlant &plant = plan.easyPlant();
  const vpServoRun &raw = *results.find(law, plant.name, plan.mainMeasure());
  const vpServoRun &shaped = *results.find(law, plant.name, plan.mainMeasure(), Command::Shaped);
  const vpTwistShaperLimits &limits = plan.scenario.shape;
  const Part linear{0, "Linear", "m/s", "m/s^2", limits.linearAcceleration};
  const Part angular{3, "Angular", "rad/s", "rad/s^2", limits.angularAcceleration};
  const StepPlots plots(raw, shaped);

  Figure figure;
  figure.name = "figure-6.1";
  figure.title = "Figure 6.1, its first second: what " + lawInfo(law).name + " commands on plant " + plant.name;
  figure.svg = vpApp::renderPanels(
      {plots.speed(linear), plots.acceleration(linear), plots.speed(angular), plots.acceleration(angular)},
      vpApp::PlotFormat::Svg);
  const bool jumps = plots.stepOf(raw, linear) > 2. * linear.limit;
  figure.caption =
      std::string(jumps ? "Raw, the speed jumps within one cycle and then decays, as in the thesis; shaped, it rises "
                          "along a ramp and joins the decay. "
                        : "") +
      "In this second the raw command asks for accelerations of up to " + number(plots.stepOf(raw, linear), 3) +
      " m/s^2 and " + number(plots.stepOf(raw, angular), 3) + " rad/s^2 at " + number(plant.loopRate, 4) +
      " cycles a second (a jump counts for twice as much at twice as many), the shaped one for up to " +
      number(plots.stepOf(shaped, linear), 3) + " m/s^2 and " + number(plots.stepOf(shaped, angular), 3) + " rad/s^2.";
  return figure;
}
} // namespace servoCompare
