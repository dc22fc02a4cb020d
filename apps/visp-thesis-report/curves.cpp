/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "curves.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace thesisReport
{
const std::string &colour(std::size_t i)
{
  static const std::array<std::string, 8> colours = {"#1f77b4", "#d62728", "#2ca02c", "#ff7f0e",
                                                     "#9467bd", "#17becf", "#8c564b", "#7f7f7f"};
  return colours[i % colours.size()];
}

vpApp::Plot overTime(const std::string &title, const std::string &quantity)
{
  vpApp::Plot plot;
  plot.title = title;
  plot.xLabel = "time (s)";
  plot.yLabel = quantity;
  plot.height = 260;
  return plot;
}

void addCurve(vpApp::Plot &plot, const std::string &label, std::vector<double> x, std::vector<double> y,
              vpApp::PlotStyle style)
{
  plot.curves.push_back({label, colour(plot.curves.size()), style, 2., std::move(x), std::move(y)});
}

void addBound(vpApp::Plot &plot, double value, bool both, const std::string &label)
{
  double begin = HUGE_VAL, end = -HUGE_VAL;
  for (const vpApp::PlotCurve &curve : plot.curves) {
    for (const double x : curve.x) {
      begin = std::min(begin, x);
      end = std::max(end, x);
    }
  }
  for (const double side : both ? std::vector<double>{value, -value} : std::vector<double>{value}) {
    plot.curves.push_back(
        {side == value ? label : "", "#555555", vpApp::PlotStyle::Dashed, 1., {begin, end}, {side, side}});
  }
}
} // namespace thesisReport
