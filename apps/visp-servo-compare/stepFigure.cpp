/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "stepFigure.h"

#include "catalogue.h"
#include "format.h"
#include "plot.h"

#include <algorithm>
#include <cmath>

namespace servoCompare
{
namespace
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

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
    Plot plot;
    plot.title = title;
    plot.xLabel = "time (s)";
    plot.yLabel = unit;
    plot.xRange = {m_begin - BEFORE, m_begin + AFTER};
    plot.fromZero = true;
    plot.height = 260;
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
