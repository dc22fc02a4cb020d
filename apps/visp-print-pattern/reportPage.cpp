/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "reportPage.h"

#include "htmlReport.h"
#include "numberText.h"
#include "tables.h"

#include <cmath>

namespace printPattern
{
namespace
{
using vpApp::fixed;
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
