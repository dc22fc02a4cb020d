/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "explorationPlots.h"

#include "influencePlot.h"
#include "numberText.h"
#include "plot.h"

#include <algorithm>
#include <cmath>
#include <functional>

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
