/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "curves.h"

#include <array>

namespace thesisReport
{
const std::string &colour(std::size_t i)
{
  static const std::array<std::string, 8> colours = {"#1f77b4", "#d62728", "#2ca02c", "#ff7f0e",
                                                     "#9467bd", "#17becf", "#8c564b", "#7f7f7f"};
  return colours[i % colours.size()];
}

void addCurve(vpApp::Plot &plot, const std::string &label, std::vector<double> x, std::vector<double> y,
              vpApp::PlotStyle style)
{
  plot.curves.push_back({label, colour(plot.curves.size()), style, 2., std::move(x), std::move(y)});
}

void addBound(vpApp::Plot &plot, double value, bool both, const std::string &label)
{
  vpApp::addLevel(plot, value, label);
  if (both) {
    vpApp::addLevel(plot, -value, "");
  }
}
} // namespace thesisReport
