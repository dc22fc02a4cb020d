/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "explorationProgram.h"

#include "explorationPlots.h"
#include "findings.h"

#include "appMain.h"
#include "htmlReport.h"
#include "numberText.h"
#include "outputFolder.h"
#include "plot.h"

#include "vpFileText.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>

namespace printExplore
{
namespace
{
using vpApp::fixed;
using vpApp::HtmlReport;
using vpApp::HtmlTable;
using vpApp::number;

constexpr std::size_t mostRows = 60; // rows of the front's table; the CSV has all

HtmlTable::Row header(const std::vector<const char *> &names)
{
  HtmlTable::Row row;
  for (const char *name : names) {
    row.emplace_back(name);
  }
  return row;
}

HtmlTable::Row rowOf(const Outcome &o, std::size_t index, bool best)
{
  const Design &d = o.design;
  HtmlTable::Row row = {std::to_string(index),
                        fixed(d.frameRate, 0),
                        std::to_string(d.width) + " x " + std::to_string(d.height),
                        number(d.pixelSize, 3),
                        number(d.exposure, 3),
                        nameOf(d.controller),
                        number(d.dropVelocity, 4) + " / " + number(d.dropVelocity * d.speedUp, 4),
                        fixed(o.timing.delayFrames, 2),
                        number(o.sensorX, 2),
                        number(o.landing95, 3),
                        number(o.landingWorst, 3),
                        fixed(o.throughput, 1),
                        number(100. * o.timing.load, 2),
                        std::string(o.thesis ? "thesis's camera" : "")};
  for (vpApp::HtmlCell &cell : row) {
    cell.style = best ? "best" : "";
  }
  return row;
}

const std::vector<const char *> COLUMNS = {"design",
                                           "frame rate, Hz",
                                           "image, px",
                                           "um/px",
                                           "exposure, us",
                                           "controller",
                                           "velocity at drops / mean, mm/s",
                                           "delay, frames",
                                           "a cell is seen to, um",
                                           "95 % land within, um",
                                           "worst, um",
                                           "cells/s",
                                           "load, % of a core",
                                           ""};

void writeFront(HtmlReport &page, const Setup &setup, const Exploration &result)
{
  page.section("The Pareto front");
  std::vector<std::size_t> front = result.front;
  const Figure &first = figureCalled(setup.objectives.front());
  std::stable_sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
    const double x = first.of(result.outcomes[a]), y = first.of(result.outcomes[b]);
    return first.more ? x > y : x < y;
  });
  HtmlTable table;
  table.header.push_back(header(COLUMNS));
  for (std::size_t i = 0; i < std::min(front.size(), mostRows); ++i) {
    const bool best = static_cast<std::ptrdiff_t>(front[i]) == result.best;
    table.rows.push_back(rowOf(result.outcomes[front[i]], front[i], best));
  }
  std::string caption = "Designs that keep what is required and that no other such one beats in one of " +
                        vpApp::enumerate(setup.objectives) +
                        " and equals in the others. Marked: the best compromise, nearest to the best of each objective "
                        "with each scaled to its range over the front.";
  if (front.size() > mostRows) {
    caption +=
        " The first " + std::to_string(mostRows) + " of " + std::to_string(front.size()) + "; front.csv has all.";
  }
  page.table(table, caption);
}

void writeThesis(HtmlReport &page, const Exploration &result)
{
  HtmlTable table;
  table.header.push_back(header(COLUMNS));
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    if (result.outcomes[i].thesis && result.outcomes[i].verdict.feasible()) {
      table.rows.push_back(rowOf(result.outcomes[i], i, false));
    }
  }
  if (!table.rows.empty()) {
    page.section("The thesis's camera");
    page.table(table, "1600 Hz, 160 x 100 px, 4.5 um/px, 50 us, 28.8 mm/s at the centres, here with vpPatternTracker.");
  }
}

void writeFeasibility(HtmlReport &page, const Exploration &result)
{
  page.section("What does not work, and why");
  HtmlTable table;
  table.header.push_back(header({"reason", "designs", "", "for instance"}));
  for (const auto &[kind, count] : reasonsOf(result)) {
    const auto example = std::find_if(result.outcomes.begin(), result.outcomes.end(),
                                      [&, k = kind](const Outcome &o) { return o.verdict.kind == k; });
    table.rows.push_back({kind, std::to_string(count), vpApp::HtmlCell(meaningOf(kind), "left"),
                          vpApp::HtmlCell(textOf(example->design) + ": " + example->verdict.sentence, "left")});
  }
  table.rows.push_back({std::string("none: they work"), std::to_string(result.feasible), std::string(), std::string()});
  page.table(table,
             "The first reason that is met counts, in the order camera, link, processor, view, delay; then what the "
             "simulation shows. explore.csv has the reason of each design.");
}

void writeSetup(HtmlReport &page, const Setup &setup, const std::string &commandLine)
{
  page.section("What was explored");
  page.paragraph("The same product, stage and print head under each camera: stage and product are described in um and "
                 "seconds and changed to the px and frames of the camera. The camera's pictures are rendered with its "
                 "magnification, exposure (motion blur, and fewer photons when shorter) and noise, and measured by "
                 "vpPatternTracker; the loop is closed through them.");
  const Task &task = setup.task;
  const Camera &camera = setup.camera;
  const Processor &p = setup.processor;
  page.facts(
      {{"designs",
        std::to_string(setup.designs.size()) + (setup.sampled ? ", samples of a sequence" : ", a full grid")},
       {"printed for each", std::to_string(task.runs) + " runs of " + std::to_string(task.cells) + " cells, jitter " +
                                number(task.jitter, 3) + " um, flexible pitch " + number(task.flex, 3) + " um"},
       {"camera", number(camera.pixelRate, 4) + " Mpx/s readout, link " + number(camera.link, 4) + " MB/s, " +
                      (camera.overlap ? "exposes while it reads out" : "exposes, then reads out") + ", " +
                      number(camera.interfaceTime, 4) + " us for grabber and output"},
       {"light", "grey " + number(camera.dark, 3) + " and " + number(camera.bright, 3) + " at " +
                     number(camera.lightExposure, 3) + " us and " + number(camera.lightPixel, 3) +
                     " um/px, proportional to exposure and pixel area, dimmed above " + number(camera.fullGrey, 3)},
       {"optics", "blur of " + number(camera.blur, 3) + " um on the product, noise ns = " + number(camera.noise, 3)},
       {"computing", "a model: " + number(p.frame, 3) + " us a frame, " + number(p.cell, 3) + " us a cell, " +
                         number(p.cellPixel, 3) + " ns a px of it; control " + number(p.pid, 3) + " us (pid), " +
                         number(p.observer, 3) + " us (observer)"},
       {"drives", "at most " + number(setup.maxAcceleration, 4) + " m/s^2"},
       {"seed", std::to_string(setup.seed)}},
      "Command: " + commandLine);
}

//! The page, self-contained.
std::string explorationPage(const Setup &setup, const Exploration &result, const std::vector<Plotted> &plots,
                            const std::string &commandLine)
{
  HtmlReport page("Exploring the design space of printing",
                  setup.name + ": which camera, controller and velocity give which accuracy, throughput and load.");
  page.highlight(findingsOf(setup, result));
  writeSetup(page, setup, commandLine);
  for (const Plotted &plot : plots) {
    if (plot.name == "front-controller") {
      page.section("Accuracy, throughput and load");
    }
    else if (plot.name == "influence") {
      page.section("What each variable does");
    }
    else if (plot.name == "cameras") {
      page.section("Frame rate against image size");
    }
    page.picture(vpApp::dataUri("image/svg+xml", plot.svg), plot.alt, plot.caption);
  }
  if (!result.front.empty()) {
    writeFront(page, setup, result);
  }
  writeThesis(page, result);
  writeFeasibility(page, result);
  page.section("What to know");
  page.list(
      {"A design is judged by a few runs: differences of a tenth of a landing error are chance. The front has the "
       "lucky "
       "ones among nearly equal designs; look at its neighbours before you buy.",
       "Drops fly straight and always alike, encoders and vibrations are not modelled, so landing errors are those of "
       "vision, control and timing alone.",
       "The computing load is a model with constants measured on one machine. It is the same on every machine that "
       "explores.",
       "The controllers' gains are not optimised for each design: they follow from the thesis's by the loop's delay "
       "(pid, "
       "pid-ff) or are the same in seconds (observer)."});
  return page.html();
}

nlohmann::ordered_json frontOf(const Setup &setup, const Exploration &result)
{
  nlohmann::ordered_json designs = nlohmann::ordered_json::array();
  for (const std::size_t index : result.front) {
    nlohmann::ordered_json design = {{"design", index}};
    design.update(jsonOf(result.outcomes[index]));
    designs.push_back(design);
  }
  return {{"name", setup.name}, {"objectives", setup.objectives}, {"front", designs}};
}

void writeResult(vpApp::OutputFolder &out, const Setup &setup, const Exploration &result,
                 const std::string &commandLine, double wallTime)
{
  const std::vector<Plotted> plots = explorationPlots(setup, result);
  for (const Plotted &plot : plots) {
    out.write("figure/" + plot.name + ".svg", plot.svg);
  }
  out.write("explore.csv", exploreCsv(result, false));
  out.write("front.csv", exploreCsv(result, true));
  out.write("front.json", frontOf(setup, result).dump(2) + "\n");
  out.write("report.html", explorationPage(setup, result, plots, commandLine));
  out.writeSummary(summaryOf(setup, result, commandLine, wallTime));
  vpApp::throwIfInterrupted();
  out.commit();
  for (const std::string &sentence : findingsOf(setup, result)) {
    std::cout << sentence << "\n";
  }
  std::cout << (out.path() / "report.html").string() << std::endl;
}
} // namespace

void exploreFile(const std::string &file, const std::string &out, unsigned int jobs, const std::string &commandLine,
                 const vpApp::Ranks &ranks)
{
  const auto start = std::chrono::steady_clock::now();
  std::string text;
  std::unique_ptr<vpApp::OutputFolder> folder;
  if (ranks.isFirst()) {
    vpApp::requireGnuplot();
    text = vpReadFileText(file);
    static_cast<void>(readSetup(text, file)); // complains before the others wait for work
    folder = std::make_unique<vpApp::OutputFolder>("visp-print-pattern", out);
  }
  const Setup setup = readSetup(ranks.broadcast(text), file);
  const Exploration result = explore(setup, ranks, jobs);
  if (folder) {
    const double wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    writeResult(*folder, setup, result, commandLine, wallTime);
  }
}
} // namespace printExplore
