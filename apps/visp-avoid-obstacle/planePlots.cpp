/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "planePlots.h"

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
} // namespace avoidObstacle
