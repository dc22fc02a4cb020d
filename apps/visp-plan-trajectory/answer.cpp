/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace planTrajectory
{
namespace
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;
using Json = nlohmann::ordered_json;

Json begun(std::size_t line, const Json &id, const std::string &status, const std::string &sentence)
{
  Json answer;
  answer["line"] = line;
  if (!id.is_null()) {
    answer["id"] = id;
  }
  answer["status"] = status;
  answer["message"] = sentence;
  return answer;
}

std::string oneLine(const Json &json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json plansOf(const Motion &motion)
{
  Json plans = Json::array();
  for (const PlanInForce &plan : motion.plans) {
    plans.push_back({{"t", plan.begin},
                     {"arrival", plan.begin + plan.plan.duration()},
                     {"form", vpToString(plan.plan.form())},
                     {"status", vpToString(plan.status.result)}});
  }
  return plans;
}

constexpr int points = 1000;      // points of a curve
constexpr int formerPoints = 250; // points of a replaced plan's continuation
constexpr double shortest = 1e-3; // time axis of a motion of zero duration, s
constexpr double gap = std::numeric_limits<double>::quiet_NaN();

// Okabe and Ito: also distinguishable for colour-blind readers.
constexpr std::array<const char *, 7> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#000000"};

std::string colourOf(int axis) { return colours[static_cast<std::size_t>(axis) % colours.size()]; }
std::string nameOf(int axis, int axes) { return axes == 1 ? "executed" : "axis " + std::to_string(axis); }

//! Time during which an input is active.
struct Interval {
  double begin = 0.;
  double end = 0.;
  const Input *input = nullptr;
};

std::vector<Interval> intervals(const Problem &problem, double duration)
{
  std::vector<Interval> list{{0., duration, &problem.input}};
  for (const Event &event : problem.events) {
    list.back().end = event.t;
    list.push_back({event.t, duration, &event.input});
  }
  return list;
}

//! Sampled so that a jump between two polynomials is drawn as a jump.
PlotCurve curveOf(const Motion &motion, int axis, std::size_t derivative)
{
  PlotCurve curve;
  for (const vpTrajectoryPiece &piece : motion.pieces) {
    const double length = piece.duration;
    const int steps = std::max(2, static_cast<int>(std::ceil(points * length / motion.duration())));
    for (int k = 0; k <= steps; ++k) {
      const double t = length * k / steps;
      const std::vector<double> &c = piece.coefficients[static_cast<std::size_t>(axis)];
      double value = 0.;
      for (std::size_t i = c.size(); i-- > derivative;) {
        double factor = 1.;
        for (std::size_t m = 0; m < derivative; ++m) {
          factor *= static_cast<double>(i - m);
        }
        value = value * t + factor * c[i];
      }
      curve.x.push_back(piece.begin + t);
      curve.y.push_back(value);
    }
  }
  if (motion.pieces.empty()) { // already at the goal
    const double value = motion.at(axis, 0.)[derivative];
    curve.x = {0., shortest};
    curve.y = {value, value};
  }
  curve.colour = colourOf(axis);
  curve.width = 2.2;
  return curve;
}

//! Continuation of the replaced plans.
PlotCurve formerCurve(const Motion &motion, int axis, std::size_t derivative)
{
  PlotCurve curve;
  for (std::size_t i = 0; i + 1 < motion.plans.size(); ++i) {
    const PlanInForce &former = motion.plans[i];
    const double rest = former.begin + former.plan.duration() - former.end;
    if (rest < 0.005 * motion.duration()) {
      continue;
    }
    for (int k = 0; k <= formerPoints; ++k) {
      const double t = former.end + rest * std::min(1. * k / formerPoints, 1. - 1e-9); // not beyond the arrival
      curve.x.push_back(t);
      curve.y.push_back(former.plan.at(axis, t - former.begin)[derivative]);
    }
    curve.x.push_back(gap);
    curve.y.push_back(gap);
  }
  curve.colour = colourOf(axis);
  curve.width = 0.8;
  return curve;
}

//! A piecewise constant value.
PlotCurve steps(const std::vector<Interval> &list, const std::function<double(const Input &)> &value, PlotStyle style)
{
  PlotCurve curve;
  for (const Interval &interval : list) {
    const double y = value(*interval.input);
    curve.x.insert(curve.x.end(), {interval.begin, interval.end});
    curve.y.insert(curve.y.end(), {std::isfinite(y) ? y : gap, std::isfinite(y) ? y : gap});
  }
  curve.style = style;
  curve.width = 1.3;
  return curve;
}

bool anyFinite(const PlotCurve &curve)
{
  return std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); });
}

//! Limits of all axes; equal ones are drawn once, in black.
void addLimits(Plot &plot, const std::vector<Interval> &list, int axes,
               const std::function<std::pair<double, double>(const Input &, int)> &limits)
{
  bool same = true;
  for (const Interval &interval : list) {
    for (int i = 1; i < axes; ++i) {
      same = same && limits(*interval.input, i) == limits(*interval.input, 0);
    }
  }
  bool named = false;
  for (int i = 0; i < (same ? 1 : axes); ++i) {
    for (const bool upper : {true, false}) {
      PlotCurve curve = steps(
          list, [&](const Input &input) { return upper ? limits(input, i).second : limits(input, i).first; },
          PlotStyle::Dashed);
      if (anyFinite(curve)) {
        curve.colour = same ? "#333333" : colourOf(i);
        curve.label = named ? "" : "limit";
        named = true;
        plot.curves.push_back(std::move(curve));
      }
    }
  }
}

void addVias(Plot &plot, const Problem &problem, const Motion &motion, int axis)
{
  const PlanInForce &last = motion.plans.back();
  const Input &input = problem.events.empty() ? problem.input : problem.events.back().input;
  PlotCurve curve;
  const std::size_t first = input.vias.size() - std::min<std::size_t>(input.vias.size(), last.plan.vias());
  for (int k = 0; k < last.plan.vias(); ++k) {
    curve.x.push_back(last.begin + last.plan.viaTime(k));
    curve.y.push_back(input.vias[first + static_cast<std::size_t>(k)].q[axis]);
  }
  if (!curve.x.empty()) {
    curve.colour = colourOf(axis);
    curve.style = PlotStyle::Points;
    curve.width = 4.;
    curve.label = axis == 0 ? "via" : "";
    plot.curves.push_back(std::move(curve));
  }
}

Plot panel(const Problem &problem, const Motion &motion, std::size_t derivative, const std::string &yLabel)
{
  Plot plot;
  plot.yLabel = yLabel;
  plot.height = 260;
  plot.xRange = {0., std::max({motion.duration(), problem.events.empty() ? 0. : problem.events.back().t, shortest})};
  const int axes = problem.axes();
  for (int i = 0; i < axes; ++i) {
    PlotCurve former = formerCurve(motion, i, derivative);
    if (anyFinite(former)) {
      former.label = i == 0 ? "without the event" : "";
      plot.curves.push_back(std::move(former));
    }
  }
  for (int i = 0; i < axes; ++i) {
    PlotCurve curve = curveOf(motion, i, derivative);
    curve.label = nameOf(i, axes);
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}
} // namespace

std::string answerLine(const Problem &problem, const Motion &motion)
{
  Json answer = begun(problem.line, problem.id, vpToString(motion.result), motion.message);
  Json velocity = Json::array();
  Json acceleration = Json::array();
  Json jerk = Json::array();
  for (const vpTrajectoryPeaks &peaks : motion.peaks) {
    velocity.push_back(peaks.velocity);
    acceleration.push_back(peaks.acceleration);
    jerk.push_back(peaks.jerk);
  }
  answer["duration"] = motion.duration();
  answer["peak_velocity"] = velocity;
  answer["peak_acceleration"] = acceleration;
  answer["peak_jerk"] = jerk;
  answer["form"] = vpToString(motion.form);
  if (motion.excess.limit != vpTrajectoryLimit::None) {
    answer["excess"] = {{"limit", vpToString(motion.excess.limit)},
                        {"index", motion.excess.index},
                        {"value", motion.excess.value},
                        {"bound", motion.excess.bound},
                        {"amount", motion.excess.amount()}};
  }
  if (motion.plans.size() > 1) {
    answer["plans"] = plansOf(motion);
  }
  Json segments = Json::array();
  for (const vpTrajectoryPiece &piece : motion.pieces) {
    segments.push_back(
        {{"t0", piece.begin}, {"t1", piece.end}, {"duration", piece.duration}, {"coefficients", piece.coefficients}});
  }
  answer["segments"] = segments;
  return oneLine(answer);
}

std::string refusalLine(std::size_t line, const Json &id, const std::string &sentence)
{
  return oneLine(begun(line, id, vpToString(vpTrajectoryResult::InvalidInput), sentence));
}

std::string csvOf(const Problem &problem, const Motion &motion)
{
  const double cycles = std::floor(motion.duration() / problem.dt * (1. + 1e-12));
  std::ostringstream csv;
  csv.imbue(std::locale::classic());
  if (cycles > maxCycles) {
    csv << problem.place << ": dt is " << problem.dt << " s, too short to sample a motion of " << motion.duration()
        << " s, at most " << maxCycles << " rows are written";
    throw std::runtime_error(csv.str());
  }
  csv << "t";
  for (int i = 0; i < problem.axes(); ++i) {
    csv << ",q" << i << ",v" << i << ",a" << i << ",j" << i;
  }
  csv << '\n';
  csv.precision(std::numeric_limits<double>::max_digits10);
  const auto row = [&](double t) {
    csv << t;
    for (int i = 0; i < problem.axes(); ++i) {
      for (const double x : motion.at(i, t)) {
        csv << ',' << x;
      }
    }
    csv << '\n';
  };
  for (long k = 0; k <= static_cast<long>(cycles); ++k) {
    row(std::min(static_cast<double>(k) * problem.dt, motion.duration()));
  }
  if (motion.duration() > cycles * problem.dt) {
    row(motion.duration());
  }
  return csv.str();
}

std::string drawMotion(const Problem &problem, const Motion &motion, const std::string &title, vpApp::PlotFormat format)
{
  const int axes = problem.axes();
  const std::vector<Interval> list = intervals(problem, std::max(motion.duration(), shortest));
  std::vector<Plot> plots{panel(problem, motion, 0, "position (unit)"), panel(problem, motion, 1, "velocity (unit/s)"),
                          panel(problem, motion, 2, "acceleration (unit/s²)"),
                          panel(problem, motion, 3, "jerk (unit/s³)")};
  plots.front().title = title;
  plots.front().height += 30;
  plots.back().xLabel = "time (s)";
  plots.back().height += 20;
  for (int i = 0; i < axes; ++i) {
    PlotCurve goal = steps(
        list, [i](const Input &input) { return input.goal.q[i]; }, PlotStyle::Dotted);
    goal.colour = colourOf(i);
    goal.label = i == 0 ? "goal" : "";
    plots[0].curves.push_back(std::move(goal));
    addVias(plots[0], problem, motion, i);
  }
  addLimits(plots[0], list, axes,
            [](const Input &x, int i) { return std::make_pair(x.minPosition[i], x.maxPosition[i]); });
  addLimits(plots[1], list, axes,
            [](const Input &x, int i) { return std::make_pair(-x.maxVelocity[i], x.maxVelocity[i]); });
  addLimits(plots[2], list, axes,
            [](const Input &x, int i) { return std::make_pair(-x.maxAcceleration[i], x.maxAcceleration[i]); });
  addLimits(plots[3], list, axes, [](const Input &x, int i) { return std::make_pair(-x.maxJerk[i], x.maxJerk[i]); });
  for (Plot &plot : plots) {
    for (const Event &event : problem.events) {
      plot.marks.push_back({event.t, &plot == &plots.front() ? "event" : ""});
    }
  }
  return vpApp::renderPanels(plots, format);
}
} // namespace planTrajectory
