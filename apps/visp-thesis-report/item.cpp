/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "item.h"

#include "numberText.h"

#include <algorithm>
#include <cmath>

namespace thesisReport
{
namespace
{
//! A CSV field, quoted if necessary.
std::string field(const std::string &text)
{
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string result = "\"";
  for (const char c : text) {
    result += c == '"' ? "\"\"" : std::string(1, c);
  }
  return result + "\"";
}
} // namespace

Verdict verdictOf(const Item &item)
{
  Verdict worst = Verdict::NoValue;
  const auto rank = [](Verdict v) {
    return v == Verdict::Differs ? 3 : v == Verdict::Better ? 2 : v == Verdict::Agrees ? 1 : 0;
  };
  for (const Quantity &quantity : item.quantities) {
    const Verdict verdict = verdictOf(quantity);
    worst = rank(verdict) > rank(worst) ? verdict : worst;
  }
  return worst;
}

std::string csvOf(const std::vector<vpApp::Plot> &panels)
{
  std::string csv = "panel,curve,x_label,y_label,x,y\n";
  for (const vpApp::Plot &panel : panels) {
    for (const vpApp::PlotCurve &curve : panel.curves) {
      const std::string head =
          field(panel.title) + "," + field(curve.label) + "," + field(panel.xLabel) + "," + field(panel.yLabel) + ",";
      for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
        if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) {
          csv += head + vpApp::number(curve.x[i], 9) + "," + vpApp::number(curve.y[i], 9) + "\n";
        }
      }
    }
  }
  return csv;
}

void addPlot(Item &item, const std::string &name, const std::string &title, const std::string &caption,
             const std::vector<vpApp::Plot> &panels)
{
  item.figures.push_back({name, title, caption, vpApp::renderPanels(panels, vpApp::PlotFormat::Svg)});
  item.data.push_back({name + ".csv", csvOf(panels)});
}
} // namespace thesisReport
