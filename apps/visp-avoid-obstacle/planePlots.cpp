/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "planePlots.h"

#include <algorithm>

namespace avoidObstacle
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

PlotCurve wayCurve(const std::string &label, const std::string &colour, const std::vector<Eigen::Vector2d> &way,
                   std::size_t thin)
{
  PlotCurve curve;
  curve.label = label;
  curve.colour = colour;
  for (std::size_t i = 0; i < way.size(); i += thin) {
    curve.x.push_back(way[i].x());
    curve.y.push_back(way[i].y());
  }
  if (!way.empty()) {
    curve.x.push_back(way.back().x());
    curve.y.push_back(way.back().y());
  }
  return curve;
}

PlotCurve placeCurve(const std::string &label, const std::string &colour, const std::vector<Eigen::Vector2d> &places)
{
  PlotCurve curve = wayCurve(label, colour, places);
  curve.style = PlotStyle::Points;
  return curve;
}

Plot wayPlot(const std::string &title)
{
  Plot plot;
  plot.title = title;
  plot.xLabel = "x (m)";
  plot.yLabel = "y (m)";
  plot.equalAxes = true;
  plot.height = 520;
  return plot;
}

Plot timePlot(const std::string &title, const std::string &unit)
{
  Plot plot;
  plot.title = title;
  plot.xLabel = "time (s)";
  plot.yLabel = unit;
  plot.height = 260;
  return plot;
}

PlotCurve timeCurve(const std::string &label, const std::string &colour, const std::vector<double> &times,
                    const std::vector<double> &values, std::size_t thin)
{
  PlotCurve curve;
  curve.label = label;
  curve.colour = colour;
  curve.width = 1.6;
  for (std::size_t i = 0; i < times.size(); i += thin) {
    curve.x.push_back(times[i]);
    curve.y.push_back(values[i]);
  }
  return curve;
}

void addLevel(Plot &plot, double level, const std::string &label)
{
  double end = 0.;
  for (const PlotCurve &curve : plot.curves) {
    end = std::max(end, curve.x.empty() ? 0. : curve.x.back());
  }
  PlotCurve line;
  line.label = label;
  line.colour = "#555555";
  line.style = PlotStyle::Dashed;
  line.width = 1.;
  line.x = {0., end};
  line.y = {level, level};
  plot.curves.push_back(line);
}
} // namespace avoidObstacle
