/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "figures.h"

#include "numberText.h"
#include "plot.h"

#include <visp3/pattern/vpMicroscopeCalibration.h>

#include <algorithm>
#include <cmath>

namespace printPattern
{
namespace
{
using vpApp::fixed;
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

constexpr const char *REFERENCE = "#000000", *MEASURED = "#9ecae1", *TRUE_VALUE = "#d62728", *LIMIT = "#2ca02c";
constexpr double FIRST_FRAMES = 160.; // frames shown in the velocity plot
constexpr double SMALL = 0.3;         // fraction of the tolerance below which it is not drawn
constexpr double PIXEL = 4.5;         // um, of figure 7.10

//! Velocities against time in seconds.
Plot velocityPlot(const vpPrintRun &run, const std::string &title)
{
  PlotCurve measured{"measured, before any filter", MEASURED, PlotStyle::Points, 1.5, {}, {}};
  PlotCurve truth{"true", TRUE_VALUE, PlotStyle::Solid, 1.8, {}, {}};
  PlotCurve reference{"reference", REFERENCE, PlotStyle::Dashed, 1.5, {}, {}};
  for (const vpPrintSample &s : run.samples) {
    const double t = s.frame / run.spec.frameRate;
    for (PlotCurve *curve : {&measured, &truth, &reference}) {
      curve->x.push_back(t);
    }
    measured.y.push_back(s.measuredVelocity);
    truth.y.push_back(s.vx);
    reference.y.push_back(s.referenceVelocity);
  }
  Plot plot;
  plot.title = title;
  plot.xLabel = "time (s)";
  plot.yLabel = "velocity (px/frame)";
  plot.curves = {measured, truth, reference};
  return plot;
}

std::string metresPerSecond(double pxPerFrame, const vpPrintExperimentSpec &spec)
{
  return fixed(pxPerFrame * spec.product.pixelSize * spec.frameRate * 1e-3, 2) + " mm/s";
}

Figure landingFigure(const vpPrintRun &run)
{
  PlotCurve along{"along the row", "#1f77b4", PlotStyle::Points, 2., {}, {}};
  PlotCurve across{"across", "#ff7f0e", PlotStyle::Points, 2., {}, {}};
  for (std::size_t i = 0; i < run.drops.size(); ++i) {
    along.x.push_back(static_cast<double>(i + 1));
    along.y.push_back(run.drops[i].errorX);
    across.x.push_back(static_cast<double>(i + 1));
    across.y.push_back(run.drops[i].errorY);
  }
  Plot plot;
  plot.title = "Where the drops landed";
  plot.xLabel = "drop";
  plot.yLabel = "landing place - centre of the cell (um)";
  plot.curves = {along, across};
  const double last = static_cast<double>(std::max<std::size_t>(1, run.drops.size()));
  for (const double limit : {Landing::tolerance, -Landing::tolerance}) {
    if (run.metrics.landing_worst_um < SMALL * Landing::tolerance) {
      break; // the lines would hide the drops
    }
    plot.curves.push_back({limit > 0. ? "tolerance" : "", LIMIT, PlotStyle::Dashed, 1.2, {1., last}, {limit, limit}});
  }
  return {"landing", "Landing errors of the drops along and across the row",
          "Each drop of the first run, in the order of landing. The tolerance of the thesis is 10 um.",
          vpApp::renderSvg(plot)};
}

Figure histogramFigure(const Landing &landing)
{
  // Bars as an outline: 40 classes up to the largest error, including the tolerance unless it is far away.
  constexpr int classes = 40;
  const bool small = landing.max < SMALL * Landing::tolerance;
  const double top = small ? 1.1 * landing.max + 0.01 : std::max(1.1 * Landing::tolerance, 1.001 * landing.max);
  const double width = top / classes;
  std::vector<double> counts(classes, 0.);
  for (const double error : landing.errors) {
    ++counts[static_cast<std::size_t>(std::min(classes - 1., std::floor(error / width)))];
  }
  PlotCurve bars{"drops", "#1f77b4", PlotStyle::Solid, 2., {0.}, {0.}};
  for (int i = 0; i < classes; ++i) {
    for (const double edge : {i * width, (i + 1) * width}) {
      bars.x.push_back(edge);
      bars.y.push_back(counts[static_cast<std::size_t>(i)]);
    }
  }
  bars.x.push_back(top);
  bars.y.push_back(0.);
  Plot plot;
  plot.title = "Landing errors";
  plot.xLabel = "distance from the centre of the cell (um)";
  plot.yLabel = "drops";
  plot.fromZero = true;
  plot.curves = {bars};
  if (!small) {
    plot.marks = {{Landing::tolerance, "tolerance"}};
  }
  return {"landing-histogram", "Histogram of the landing errors",
          std::to_string(landing.errors.size()) + " drops of all runs: median " + fixed(landing.p50, 2) +
              " um, 99 % within " + fixed(landing.p99, 2) + " um, largest " + fixed(landing.max, 2) + " um.",
          vpApp::renderSvg(plot)};
}

std::string captionOf(const Replica &replica)
{
  const vpPrintRun &run = replica.runs.front();
  std::string text = "Velocity error from frame " + std::to_string(run.spec.evaluateFrom) + " on, rms of " +
                     std::to_string(replica.runs.size()) + " runs: " + fixed(replica.rms_velocity_error, 3) +
                     " px/frame = " + metresPerSecond(replica.rms_velocity_error, run.spec) + " as measured";
  text += replica.thesis > 0. ? ", " + fixed(replica.thesis, 2) + " px/frame in the thesis" : "";
  return text + "; at the centres of the cells " + fixed(replica.centre_velocity_error, 3) +
         " px/frame. The first run is drawn.";
}
} // namespace

std::vector<Figure> ownFigures(const Results &results)
{
  const vpPrintRun &run = results.runs.front();
  Plot velocity = velocityPlot(run, "Velocity of the product");
  velocity.xRange = {0., std::min<double>(FIRST_FRAMES, static_cast<double>(run.samples.size())) / run.spec.frameRate};
  return {{"velocity", "Reference, true and measured velocity of the product",
           "The beginning of the first run. Slowest at the centres of the cells, where the drops land. The measured "
           "velocity "
           "is that of the last two frames that arrived, so it comes later than the true one.",
           vpApp::renderSvg(velocity)},
          landingFigure(run),
          histogramFigure(results.landing)};
}

std::vector<Figure> thesisFigures(const Results &results)
{
  std::vector<Figure> figures;
  for (const Replica &replica : results.replicas) {
    const std::string title = "Figure " + replica.figure + ": " + replica.name;
    figures.push_back({"figure-" + replica.figure, title, captionOf(replica),
                       vpApp::renderSvg(velocityPlot(replica.runs.front(), title))});
  }
  int number = 0;
  for (const Replica &observer : results.observers) {
    figures.push_back({"observer-" + std::to_string(++number), observer.name, captionOf(observer),
                       vpApp::renderSvg(velocityPlot(observer.runs.front(), observer.name))});
  }
  return figures;
}

Figure distortionFigure()
{
  Plot plot;
  plot.title = "Figure 7.10: mismatch of pixel locations by radial distortion";
  plot.xLabel = "distance from the middle of the image (px)";
  plot.yLabel = "mismatch (px)";
  const std::vector<std::pair<double, std::string>> shares = {
      {0.01, "#d62728"}, {0.005, "#ff7f0e"}, {0.002, "#2ca02c"}, {0.001, "#1f77b4"}};
  vpMicroscopeCalibration microscope;
  microscope.scaleX = microscope.scaleY = 1e6 / PIXEL;
  for (const auto &share : shares) {
    PlotCurve curve{fixed(100. * share.first, 1) + " % at 200 px", share.second, PlotStyle::Solid, 2., {}, {}};
    microscope.kappa1 = share.first / (200. * 200.);
    for (double r = 0.; r <= 200.; r += 4.) {
      curve.x.push_back(r);
      curve.y.push_back(microscope.toPlane(r, 0.)[0] * microscope.scaleX - r);
    }
    plot.curves.push_back(curve);
  }
  plot.marks = {{80., "edge of a 160 px image"}};
  return {
      "figure-7.10", "Figure 7.10: mismatch of pixel locations for several radial distortions",
      "It grows with the cube of the distance: 1 % at 200 px is 2 px there and 0.13 px at the edge of a 160 px image, "
      "0.1 % is 0.013 px there, less than the tracker's error of a cell. From the calibration's own model.",
      vpApp::renderSvg(plot)};
}
} // namespace printPattern
