/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "reportPage.h"

#include "htmlReport.h"
#include "numberText.h"
#include "plot.h"
#include "tables.h"

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

using vpApp::HtmlReport;
using vpApp::HtmlTable;

std::string percent(double share, int decimals) { return fixed(100. * share, decimals) + " %"; }

std::string plural(int count, const std::string &noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void writeAnswer(HtmlReport &page, const Results &results)
{
  const std::vector<vpPrintRun> &runs = results.runs;
  const int printed = sumOf(runs, &vpPrintMetrics::printed), missed = sumOf(runs, &vpPrintMetrics::missed);
  const int doubled = sumOf(runs, &vpPrintMetrics::doubled);
  const Landing &landing = results.landing;
  std::vector<std::string> answer = {plural(printed, "cell") + " printed, " + std::to_string(missed) + " missed, " +
                                     std::to_string(doubled) + " printed twice."};
  if (!landing.errors.empty()) {
    answer.push_back("Drops land " + fixed(landing.p50, 2) + " um from the centre (median), 99 % within " +
                     fixed(landing.p99, 2) + " um, the worst " + fixed(landing.max, 2) + " um off; " +
                     percent(landing.within, 1) + " within the tolerance of 10 um.");
  }
  int left = 0;
  for (const vpPrintRun &run : runs) {
    left += run.spec.rows * run.spec.cellsPerRow - run.metrics.printed - run.metrics.missed;
  }
  if (left > 0) {
    answer.push_back(plural(left, "cell") +
                     " never came to the nozzle: the run was ended by --frames, or the controller "
                     "stopped short of the last cell.");
  }
  const double gain = meanOf(runs, &vpPrintMetrics::gain_over_constant);
  answer.push_back(fixed(meanOf(runs, &vpPrintMetrics::throughput_cells_per_s), 1) + " cells a second, " +
                   (gain >= 0. ? percent(gain, 1) + " faster" : percent(-gain, 1) + " slower") +
                   " between the cells of a row than at the constant velocity at which the drops fall.");
  page.highlight(answer);
}

void writeRun(HtmlReport &page, const Options &options, const Results &results, const ReportParts &parts)
{
  const vpPrintExperimentSpec &spec = options.spec;
  page.section("What was run");
  page.paragraph("A product with repeated cells moves under a camera and a nozzle. There is no other encoder than the "
                 "cells: each frame gives their places, the motion follows from it, and a drop is fired into each cell "
                 "on the fly. Everything is simulated: the pictures are rendered, the stage has friction, stiction, "
                 "lag and delay.");
  const std::string sensors =
      options.sensor == "image" ? "rendered pictures, measured by vpPatternTracker"
                                : (options.sensor == "tracker" ? "true places with the errors of vpPatternTracker"
                                                               : "true places with the errors of the thesis's sensor");
  std::vector<std::pair<std::string, std::string>> facts = {
      {"controller", nameOf(spec.controller)},
      {"sensor", sensors},
      {"reference", nameOf(spec.reference.mode) + ", " + fixed(spec.dropVelocity, 2) + " px/frame at the centres"},
      {"trigger",
       spec.trigger == vpPrintTriggerMethod::Horizon ? "on a horizon, each cell once" : "algorithm 7.5 as printed"},
      {"cells", std::to_string(spec.rows) + " x " + std::to_string(spec.cellsPerRow) + ", pitch " +
                    fixed(spec.product.pitchX, 1) + " x " + fixed(spec.product.pitchY, 1) + " px"},
      {"flexible pitch",
       fixed(spec.product.flexAmplitudeX, 2) + " px over " + fixed(spec.product.flexPeriodX, 0) + " cells"},
      {"camera", fixed(spec.frameRate, 0) + " frames a second, " + fixed(spec.visionDelay, 2) +
                     " frames late, noise ns = " + fixed(spec.product.noise, 1)},
      {"runs", std::to_string(results.runs.size())}};
  page.facts(facts, "The user's run. Command: " + parts.commandLine);
  page.section("The result");
  const auto rms = [&](double vpPrintMetrics::*figure) { return fixed(rmsOf(results.runs, figure), 4) + " px/frame"; };
  page.facts({{"velocity error as measured", rms(&vpPrintMetrics::rms_velocity_error)},
              {"velocity error, true", rms(&vpPrintMetrics::rms_true_velocity_error)},
              {"true velocity error at the centres", rms(&vpPrintMetrics::centre_velocity_error)}},
             "Root mean square from frame " + std::to_string(spec.evaluateFrom) +
                 " on. The first compares what the "
                 "camera sees before any filter with the reference, as the thesis does.");
  page.picture(
      vpApp::dataUri("image/png", parts.printed), "The product with the drops on it",
      "The printed product (first run): drops are circles of 50 um, green within 10 um of the centre, red beyond; "
      "the cross is the true centre of the cell.");
  for (const Figure &figure : parts.own) {
    page.picture(vpApp::dataUri("image/svg+xml", figure.svg), figure.alt, figure.caption);
  }
  if (!parts.video.empty()) {
    page.videos({{parts.video, "What the camera sees, 64 times slower than real; yellow marks: the nozzle."}});
  }
}

void writeIdentification(HtmlReport &page, const Identification &identification)
{
  const vpFrictionIdentification &found = identification.found;
  page.section("Mass and friction of the stage");
  HtmlTable table;
  HtmlTable::Row header;
  for (const char *name : {"", "found", "standard deviation", "true"}) {
    header.emplace_back(name);
  }
  table.header.push_back(header);
  const auto row = [&](const char *name, double estimate, double sigma, double truth) {
    table.rows.push_back({std::string(name), fixed(estimate, 4), fixed(sigma, 4), fixed(truth, 4)});
  };
  row("mass", found.model.mass, found.sigmaMass, identification.truth.mass);
  row("viscous friction, per px/frame", found.model.viscous, found.sigmaViscous, identification.truth.viscous);
  row("Coulomb friction, px/frame^2", found.model.coulomb, found.sigmaCoulomb, identification.truth.coulomb);
  row("stiction, px/frame^2", found.model.stiction, found.sigmaStiction, identification.truth.stiction);
  page.table(table, std::string(found.message()) + " From " + std::to_string(identification.frames) +
                        " frames of a force that swings with growing strength, open loop, watched by the camera; the "
                        "run used what was found. The standard deviations know of noise only; smoothing leaves about 1 "
                        "% of the mass. Stiction is what a fit of slow motion says, which is the hardest to see.");
}

void writeThesis(HtmlReport &page, const Results &results, const ReportParts &parts)
{
  page.section("The experiments of the thesis");
  HtmlTable table;
  HtmlTable::Row header;
  for (const char *name :
       {"figure", "control", "velocity error, px/frame", "the thesis", "ratio", "at the centres, px/frame"}) {
    header.emplace_back(name);
  }
  table.header.push_back(header);
  for (const auto *list : {&results.replicas, &results.observers}) {
    for (const Replica &replica : *list) {
      table.rows.push_back({replica.figure, replica.name, fixed(replica.rms_velocity_error, 3),
                            replica.thesis > 0. ? fixed(replica.thesis, 2) : "-",
                            replica.thesis > 0. ? fixed(replica.rms_velocity_error / replica.thesis, 2) : "-",
                            fixed(replica.centre_velocity_error, 3)});
    }
  }
  page.table(table,
             "Root mean square over 8 seeds, as measured and before any filter. Stage and gains are one set that "
             "shows the thesis's figures: it was searched for, is not unique and not robust. With the thesis's "
             "sensor the measured error of any controller is mostly noise; what matters for a drop is the true "
             "velocity at the centre, in the last column.");
  for (const Figure &figure : parts.thesis) {
    page.picture(vpApp::dataUri("image/svg+xml", figure.svg), figure.alt, figure.caption);
    if (figure.name == "figure-7.10") {
      page.picture(vpApp::dataUri("image/png", parts.detection), "Threshold image and detected cells",
                   "Figure 7.11: on the left the image after Otsu's threshold, on the right boxes and centres that "
                   "algorithm 7.4 finds, as printed; crosses are the true centres. Its centres are half a pixel to the "
                   "right.");
    }
  }
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

std::string reportPage(const Options &options, const Results &results, const ReportParts &parts)
{
  HtmlReport page("Printing on the fly", "Drops on a moving, flexible product, with the camera as the only encoder.");
  writeAnswer(page, results);
  writeRun(page, options, results, parts);
  if (results.identification) {
    writeIdentification(page, *results.identification);
  }
  if (!parts.thesis.empty()) {
    writeThesis(page, results, parts);
  }
  page.section("What to know");
  page.list(
      {"Stage, product, camera and drops are simulated; a drop flies straight and takes the same time always.",
       "The stage's friction is known to the observer but for the 30 % more beyond the fifth cell, which it estimates.",
       "The throughput counts from the first drop to the last and includes turning between rows."});
  return page.html();
}
} // namespace printPattern
