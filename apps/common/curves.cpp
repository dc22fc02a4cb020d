/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "curves.h"

#include <algorithm>

namespace vpApp
{
Plot timePlot(const std::string &title, const std::string &yLabel, unsigned int height)
{
  Plot plot;
  plot.title = title;
  plot.xLabel = "time (s)";
  plot.yLabel = yLabel;
  plot.height = height;
  return plot;
}

void addLevel(Plot &plot, double level, const std::string &label)
{
  std::pair<double, double> range = plot.xRange;
  for (const PlotCurve &curve : plot.curves) {
    if (!curve.x.empty()) {
      const auto ends = std::minmax_element(curve.x.begin(), curve.x.end());
      range = range.first < range.second
                  ? std::make_pair(std::min(range.first, *ends.first), std::max(range.second, *ends.second))
                  : std::make_pair(*ends.first, *ends.second);
    }
  }
  plot.curves.push_back({label, "#555555", PlotStyle::Dashed, 1., {range.first, range.second}, {level, level}});
}
} // namespace vpApp
