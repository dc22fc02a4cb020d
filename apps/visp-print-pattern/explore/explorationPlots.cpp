/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "explorationPlots.h"

#include "numberText.h"
#include "plot.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace printExplore
{
namespace
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

constexpr const char *GREY = "#c3c8ce", *BLACK = "#000000", *RED = "#d62728";

PlotCurve points(const std::string &label, const char *colour, double size, PlotStyle style = PlotStyle::Points)
{
  return {label, colour, style, size, {}, {}};
}

void add(PlotCurve &curve, const Outcome &outcome, const Figure &x, const Figure &y)
{
  curve.x.push_back(x.of(outcome));
  curve.y.push_back(y.of(outcome));
}

//! \brief A colour and its meaning.
struct Kind {
  std::string label;
  const char *colour;
  std::function<bool(const Outcome &)> holds;
};

std::vector<Kind> byController()
{
  std::vector<Kind> kinds;
  const std::vector<std::pair<vpPrintController, const char *>> all = {{vpPrintController::Pid, "#2ca02c"},
                                                                       {vpPrintController::PidFeedforward, "#ff7f0e"},
                                                                       {vpPrintController::Observer, "#1f77b4"}};
  for (const auto &[controller, colour] : all) {
    kinds.push_back(
        {nameOf(controller), colour, [which = controller](const Outcome &o) { return o.design.controller == which; }});
  }
  return kinds;
}

//! Terciles of the loads, light to dark.
std::vector<Kind> byLoad(const Exploration &result)
{
  std::vector<double> loads;
  for (const Outcome &outcome : result.outcomes) {
    if (outcome.verdict.feasible()) {
      loads.push_back(outcome.timing.load);
    }
  }
  std::sort(loads.begin(), loads.end());
  const std::vector<const char *> colours = {"#9ecae1", "#4292c6", "#08306b"};
  std::vector<Kind> kinds;
  double low = -1.;
  for (std::size_t i = 0; i < colours.size() && !loads.empty(); ++i) {
    const double high = loads[(loads.size() - 1) * (i + 1) / colours.size()];
    if (high > low) {
      kinds.push_back({"load up to " + vpApp::number(100. * high, 2) + " %", colours[i],
                       [low, high](const Outcome &o) { return o.timing.load > low && o.timing.load <= high; }});
      low = high;
    }
  }
  return kinds;
}

//! Feasible designs in the plane of two metrics; rings: the front.
Plot frontPlot(const Setup &setup, const Exploration &result, const std::vector<Kind> &kinds, const std::string &title)
{
  const Figure &y = figureCalled(setup.objectives[0]);
  const Figure &x = figureCalled(setup.objectives[std::min<std::size_t>(1, setup.objectives.size() - 1)]);
  Plot plot;
  plot.title = title;
  plot.xLabel = x.text;
  plot.yLabel = y.text;
  plot.logY = true;
  plot.width = 1060;
  PlotCurve front = points("Pareto front", BLACK, 6., PlotStyle::Rings);
  PlotCurve thesis = points("thesis's camera", RED, 9., PlotStyle::Rings);
  PlotCurve best = points("best compromise", "#9467bd", 9., PlotStyle::Rings);
  for (const Kind &kind : kinds) {
    PlotCurve curve = points(kind.label, kind.colour, 3.);
    for (const Outcome &outcome : result.outcomes) {
      if (outcome.verdict.feasible() && kind.holds(outcome)) {
        add(curve, outcome, x, y);
      }
    }
    if (!curve.x.empty()) {
      plot.curves.push_back(curve);
    }
  }
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    const Outcome &outcome = result.outcomes[i];
    if (outcome.verdict.feasible() && outcome.front) {
      add(front, outcome, x, y);
    }
    if (outcome.verdict.feasible() && outcome.thesis) {
      add(thesis, outcome, x, y);
    }
    if (static_cast<std::ptrdiff_t>(i) == result.best) {
      add(best, outcome, x, y);
    }
  }
  for (const PlotCurve &curve : {front, thesis, best}) {
    if (!curve.x.empty()) {
      plot.curves.push_back(curve);
    }
  }
  return plot;
}

//! Figure 7.1: image size against frame rate, with the limits of camera and link.
Plotted cameraPlot(const Setup &setup, const Exploration &result)
{
  PlotCurve works = points("at least one design works", "#1f77b4", 4.), fails = points("none works", GREY, 4.);
  double leastRate = 1e300, mostRate = 0., shortest = 1e300;
  for (const Outcome &outcome : result.outcomes) {
    const Design &d = outcome.design;
    leastRate = std::min(leastRate, d.frameRate);
    mostRate = std::max(mostRate, d.frameRate);
    shortest = std::min(shortest, d.exposure);
    const bool any = std::any_of(result.outcomes.begin(), result.outcomes.end(), [&](const Outcome &other) {
      return other.verdict.feasible() && other.design.frameRate == d.frameRate && other.design.width == d.width &&
             other.design.height == d.height;
    });
    PlotCurve &curve = any ? works : fails;
    curve.x.push_back(d.frameRate);
    curve.y.push_back(d.pixels());
  }
  PlotCurve thesis = points("thesis's camera", RED, 8., PlotStyle::Rings);
  const Design ofThesis = Design::thesis(vpPrintController::Observer);
  thesis.x.push_back(ofThesis.frameRate);
  thesis.y.push_back(ofThesis.pixels());
  PlotCurve readout{"readout, exposure of " + vpApp::number(shortest, 3) + " us", RED, PlotStyle::Solid, 2., {}, {}};
  PlotCurve link{"link", "#2ca02c", PlotStyle::Dashed, 2., {}, {}};
  constexpr int steps = 100;
  for (int i = 0; i <= steps; ++i) {
    const double rate = 0.8 * leastRate * std::pow(1.25 * 1.25 * mostRate / leastRate, static_cast<double>(i) / steps);
    const double left = 1e6 / rate - (setup.camera.overlap ? 0. : shortest); // us for the readout
    if (left > 0.) {
      readout.x.push_back(rate);
      readout.y.push_back(left * setup.camera.pixelRate);
      link.x.push_back(rate);
      link.y.push_back(setup.camera.link * 1e6 / rate);
    }
  }
  Plot plot;
  plot.title = "Frame rate and image size, (7.2) and figure 7.1";
  plot.xLabel = "frame rate (Hz)";
  plot.yLabel = "image size (px)";
  plot.logX = plot.logY = true;
  plot.width = 1060;
  plot.curves = {fails, works, thesis, readout, link};
  return {
      "cameras", "Image size against frame rate with the limits of camera and link",
      "Above the red line the camera cannot read out an image before the next one, above the green one the link cannot "
      "carry it. A grey point below both has another reason: too few cells in view, cells missed, the tracker.",
      vpApp::renderSvg(plot)};
}

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

//! Influence of each variable on the first objective. One panel per varying variable: all feasible designs, the best one and the median at each value.
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
} // namespace

std::vector<Plotted> explorationPlots(const Setup &setup, const Exploration &result)
{
  std::vector<Plotted> plots;
  if (result.feasible > 0) {
    plots.push_back({"front-controller", "Designs that work, by controller, with the Pareto front",
                     "Each point is a design that works. Rings: it keeps what is required, and no other such design is "
                     "better in one objective and as good in all "
                     "others; where a ring lies behind others in this plane, it needs less of another objective.",
                     vpApp::renderSvg(frontPlot(setup, result, byController(), "Designs by controller"))});
    plots.push_back({"front-load", "The same designs, by computing load", "The same, darker for more computing.",
                     vpApp::renderSvg(frontPlot(setup, result, byLoad(result), "Designs by computing load"))});
    plots.push_back(influencePlot(setup, result));
  }
  plots.push_back(cameraPlot(setup, result));
  return plots;
}
} // namespace printExplore
