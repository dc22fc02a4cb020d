/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figure 8.6: a potential field as printed, with two sets of parameters.
#include "fieldMotion.h"
#include "planePlots.h"
#include "replicas.h"

#include "numberText.h"

#include <cmath>

namespace avoidObstacle
{
namespace
{
using Eigen::Vector2d;
using vpApp::number;

constexpr double REACHED = 0.005; // m
constexpr int CIRCLE_POINTS = 90;

std::vector<Vector2d> circle(const Vector2d &centre, double radius)
{
  std::vector<Vector2d> points;
  for (int i = 0; i <= CIRCLE_POINTS; ++i) {
    const double angle = 2. * M_PI * i / CIRCLE_POINTS;
    points.emplace_back(centre + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

vpApp::Plot draw(const FieldTask &task, const FieldMotion &motion, const FieldMotion &undisturbed,
                 const std::string &title)
{
  vpApp::Plot plot = wayPlot(title);
  plot.curves = {wayCurve("way", "#d62728", motion.way, 4), wayCurve("without obstacle", "#999999", undisturbed.way, 4),
                 placeCurve("vias and end", "#1f77b4", task.places), placeCurve("obstacle", "#000000", {task.obstacle}),
                 wayCurve("distance d_0: half the weight", "#000000", circle(task.obstacle, motion.weight.centre))};
  plot.curves[1].style = plot.curves.back().style = vpApp::PlotStyle::Dashed;
  plot.curves.back().width = 1.;
  return plot;
}

std::string csvOf(const FieldMotion &motion)
{
  std::string csv = "time_s,x_m,y_m,weight\n";
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    csv += number(motion.times[i], 7) + "," + number(motion.way[i].x(), 9) + "," + number(motion.way[i].y(), 9) + "," +
           number(motion.weights[i], 9) + "\n";
  }
  return csv;
}

std::string missedText(const FieldMotion &motion)
{
  std::vector<std::string> parts;
  for (const double m : motion.missed) {
    parts.push_back(number(1000. * m, 3));
  }
  return vpApp::enumerate(parts) + " mm";
}

void add(const char *name, const FieldMotion &motion, Replica &replica)
{
  replica.tables.emplace_back(std::string("samples-") + name + ".csv", csvOf(motion));
  replica.numbers[name] = {{"d0_m", motion.weight.centre},
                           {"ks_m", motion.weight.width},
                           {"missed_m", motion.missed},
                           {"end_m", {motion.way.back().x(), motion.way.back().y()}},
                           {"end_reached", motion.missed.back() < REACHED},
                           {"peak_v", motion.peakSpeed}};
}
} // namespace

Replica playFieldReplica(const Options &options)
{
  Replica replica;
  replica.name = options.replica;
  replica.title = replicaTitle(options.replica);
  const FieldTask task;
  const FieldMotion strict = followField(task, strictField()), mild = followField(task, mildField()),
                    undisturbed = followField(task, mildField(), false);
  const bool strictFails = strict.missed.back() >= REACHED, mildReaches = mild.missed.back() < REACHED;
  replica.findings = {"With the strict parameters the point ends " + number(1000. * strict.missed.back(), 3) +
                          " mm from its end and " + (strictFails ? "does not reach it" : "reaches it") +
                          ", with the mild ones " + number(1000. * mild.missed.back(), 3) +
                          " mm from it, which counts as " + (mildReaches ? "reached." : "missed."),
                      "Nothing is known of speeds beforehand: they go up to " + number(strict.peakSpeed, 3) + " and " +
                          number(mild.peakSpeed, 3) +
                          " m/s and jump where a new position is given or the obstacle comes into view."};
  replica.comparisons = {{"strict (upper): end reached", "no", strictFails ? "no" : "yes", strictFails},
                         {"mild (lower): end reached", "yes", mildReaches ? "yes" : "no", mildReaches},
                         {"strict: vias reached", "no", "missed by " + missedText(strict) + " (the end last)",
                          strict.missed[1] >= REACHED},
                         {"mild stays closer to the way without obstacle", "yes",
                          "missed by " + missedText(mild) + " (the end last)", mild.missed[1] < strict.missed[1]},
                         {"bounds on speed and acceleration", "none", "none"},
                         {"clearance", "not given",
                          number(1000. * (strict.way.back() - task.obstacle).norm(), 3) + " and " +
                              number(1000. * (mild.way.back() - task.obstacle).norm(), 3) +
                              " mm from the obstacle's centre in the end"}};
  replica.choices = {
      "The thesis gives no numbers: places, obstacle, d_0 = 0.12 and 0.06 m, k_s = 0.06 and 0.03 m, w_s = 0.5, gain 2 "
      "/s "
      "and x'_oa = 0.25 m/s are ours. Distances are in m instead of px, which is a matter of scale.",
      "As in the text only x is affected by the obstacle; the camera sees it while it is within 0.2 m along y."};
  add("strict", strict, replica);
  add("mild", mild, replica);
  vpApp::Plot weights = vpApp::timePlot("Weight of avoidance", "0..1");
  weights.curves = {vpApp::timeCurve("strict", "#d62728", strict.times, strict.weights),
                    vpApp::timeCurve("mild", "#1f77b4", mild.times, mild.weights)};
  Figure figure;
  figure.name = "motion";
  figure.title = "The ways with strict (top) and mild (middle) parameters, and the weights";
  figure.caption = "The circle is where the weight has fallen by half.";
  figure.svg = vpApp::renderPanels(
      {draw(task, strict, undisturbed, "Strict parameters"), draw(task, mild, undisturbed, "Mild parameters"), weights},
      vpApp::PlotFormat::Svg);
  replica.figures = {figure};
  return replica;
}
} // namespace avoidObstacle
