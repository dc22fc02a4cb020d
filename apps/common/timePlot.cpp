/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "timePlot.h"

#include <algorithm>

namespace vpApp
{
namespace
{
constexpr std::size_t CURVE_POINTS = 800; // more would not be visible
}

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

PlotCurve timeCurve(const std::string &label, const std::string &colour, std::size_t count,
                    const std::function<double(std::size_t)> &time, const std::function<double(std::size_t)> &value,
                    Keep keep)
{
  PlotCurve curve;
  curve.label = label;
  curve.colour = colour;
  curve.width = 1.6;
  const std::size_t stride = std::max<std::size_t>(1, count / CURVE_POINTS);
  for (std::size_t i = 0; i < count; i += stride) {
    double shown = value(i);
    for (std::size_t k = i + 1; k < std::min(i + stride, count); ++k) {
      shown = keep == Keep::Least ? std::min(shown, value(k)) : std::max(shown, value(k));
    }
    curve.x.push_back(time(i));
    curve.y.push_back(shown);
  }
  return curve;
}

PlotCurve timeCurve(const std::string &label, const std::string &colour, const std::vector<double> &times,
                    const std::vector<double> &values, Keep keep)
{
  return timeCurve(
      label, colour, times.size(), [&](std::size_t i) { return times[i]; }, [&](std::size_t i) { return values[i]; },
      keep);
}
} // namespace vpApp
