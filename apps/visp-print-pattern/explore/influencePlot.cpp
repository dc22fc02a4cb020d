/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "influencePlot.h"

#include "numberText.h"
#include "plot.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <map>

namespace printExplore
{
namespace
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

constexpr std::size_t mostClasses = 8; // maximum number of classes of a variable

//! \brief A variable of a design: sort key and name of its value.
struct Variable {
  const char *text;
  double (*value)(const Design &);
  std::string (*name)(const Design &);
};

const std::vector<Variable> &variables()
{
  using vpApp::number;
  static const std::vector<Variable> all = {
      {"frame rate (Hz)", [](const Design &d) { return d.frameRate; },
       [](const Design &d) { return vpApp::fixed(d.frameRate, 0); }},
      {"image (px)", [](const Design &d) { return d.pixels() + 1e-6 * d.width; },
       [](const Design &d) { return std::to_string(d.width) + " x " + std::to_string(d.height); }},
      {"magnification (um/px)", [](const Design &d) { return d.pixelSize; },
       [](const Design &d) { return number(d.pixelSize, 3); }},
      {"exposure (us)", [](const Design &d) { return d.exposure; },
       [](const Design &d) { return number(d.exposure, 3); }},
      {"controller", [](const Design &d) { return static_cast<double>(d.controller); },
       [](const Design &d) { return nameOf(d.controller); }},
      {"velocity at the drops (mm/s)", [](const Design &d) { return d.dropVelocity; },
       [](const Design &d) { return number(d.dropVelocity, 4); }},
      {"mean velocity over that at the drops", [](const Design &d) { return d.speedUp; },
       [](const Design &d) { return number(d.speedUp, 3); }}};
  return all;
}

//! Values in classes: one per value, or octiles of the designs if there are many.
std::map<double, std::size_t> classesOf(const std::vector<Outcome> &outcomes, const Variable &variable)
{
  std::vector<double> values;
  for (const Outcome &outcome : outcomes) {
    values.push_back(variable.value(outcome.design));
  }
  std::sort(values.begin(), values.end());
  std::vector<double> different = values;
  different.erase(std::unique(different.begin(), different.end()), different.end());
  std::map<double, std::size_t> classes;
  for (const double value : different) {
    const auto before =
        static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
    classes[value] = different.size() <= mostClasses ? classes.size() : before * mostClasses / values.size();
  }
  return classes;
}

Plot panelOf(const Variable &variable, const std::map<double, std::size_t> &classes, const Figure &figure,
             const std::vector<Outcome> &outcomes)
{
  std::map<std::size_t, std::pair<std::string, std::string>> names; // first and last of a class
  std::map<std::size_t, std::vector<double>> figures;
  std::map<std::string, std::size_t> seen;
  for (const auto &[value, k] : classes) {
    const auto found = std::find_if(outcomes.begin(), outcomes.end(),
                                    [&, v = value](const Outcome &o) { return variable.value(o.design) == v; });
    const std::string name = variable.name(found->design);
    names.emplace(k, std::make_pair(name, name));
    names[k].second = name;
  }
  PlotCurve all{"designs that work", "#9ecae1", PlotStyle::Points, 2.2, {}, {}};
  for (const Outcome &outcome : outcomes) {
    if (outcome.verdict.feasible()) {
      const std::size_t k = classes.at(variable.value(outcome.design));
      const double aside = 0.05 * (static_cast<double>(seen[std::to_string(k)]++ % 9) - 4.);
      all.x.push_back(static_cast<double>(k) + aside);
      all.y.push_back(figure.of(outcome));
      figures[k].push_back(figure.of(outcome));
    }
  }
  PlotCurve best{"best", "#d62728", PlotStyle::Solid, 2., {}, {}},
      median{"median", "#1f77b4", PlotStyle::Solid, 2., {}, {}};
  for (const auto &[k, values] : figures) {
    for (PlotCurve *curve : {&best, &median}) {
      curve->x.push_back(static_cast<double>(k));
    }
    best.y.push_back(vpQuantile(values, figure.more ? 1. : 0.));
    median.y.push_back(vpMedian(values));
  }
  Plot plot;
  plot.yLabel = figure.text;
  plot.xLabel = variable.text;
  for (const auto &[k, ends] : names) {
    plot.categories.push_back(ends.first == ends.second ? ends.first : ends.first + " to " + ends.second);
  }
  plot.xRange = {-0.5, static_cast<double>(names.size()) - 0.5};
  plot.logY = true;
  plot.width = 1060;
  plot.height = 330;
  PlotCurve bestPoints = best, medianPoints = median; // a single class has no line
  bestPoints.style = medianPoints.style = PlotStyle::Points;
  bestPoints.label = medianPoints.label = "";
  bestPoints.width = medianPoints.width = 3.;
  plot.curves = {all, median, medianPoints, best, bestPoints};
  return plot;
}
} // namespace

Plotted influencePlot(const Setup &setup, const Exploration &result)
{
  const Figure &figure = figureCalled(setup.objectives.front());
  std::vector<Plot> panels;
  for (const Variable &variable : variables()) {
    const auto classes = classesOf(result.outcomes, variable);
    if (classes.size() > 1 || panels.empty()) {
      panels.push_back(panelOf(variable, classes, figure, result.outcomes));
    }
  }
  return {
      "influence", "The first objective against each variable, best and median of the designs that work",
      "Designs that work at each value of a variable, all others being whatever they are. A value without points: no "
      "design works with it. The red line is what can be had with the best choice of all others.",
      vpApp::renderPanels(panels, vpApp::PlotFormat::Svg)};
}
} // namespace printExplore
