/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "explorationProgram.h"

#include "findings.h"

#include "appMain.h"
#include "numberText.h"
#include "outputFolder.h"
#include "report.h"

#include "vpFileText.h"

#include <chrono>
#include <iostream>
#include <memory>

namespace printExplore
{
namespace
{
using vpApp::number;

using Json = nlohmann::ordered_json;

//! What was explored, as names and sentences.
Json factsOf(const Setup &setup)
{
  const Task &task = setup.task;
  const Camera &camera = setup.camera;
  const Processor &p = setup.processor;
  return {
      {"designs", std::to_string(setup.designs.size()) + (setup.sampled ? ", samples of a sequence" : ", a full grid")},
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
      {"seed", std::to_string(setup.seed)}};
}

//! What the report needs besides explore.csv and summary.json.
Json setupOf(const Setup &setup)
{
  Json metrics = Json::object();
  for (const Figure &figure : figures()) {
    metrics[figure.name] = {{"text", figure.text}, {"more", figure.more}};
  }
  Json meanings = Json::object();
  for (const char *kind : {"camera", "link", "processor", "view", "delay", "tracker", "cells", "model"}) {
    meanings[kind] = meaningOf(kind);
  }
  return {{"facts", factsOf(setup)},        {"metrics", metrics},
          {"meanings", meanings},           {"pixel_rate_mpx_s", setup.camera.pixelRate},
          {"link_mb_s", setup.camera.link}, {"overlap", setup.camera.overlap}};
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
  out.write("explore.csv", exploreCsv(result, false));
  out.write("front.csv", exploreCsv(result, true));
  out.write("front.json", frontOf(setup, result).dump(2) + "\n");
  out.write("setup.json", setupOf(setup).dump(2) + "\n");
  vpApp::finishWithReport(out, summaryOf(setup, result, commandLine, wallTime));
  for (const std::string &sentence : findingsOf(setup, result)) {
    std::cout << sentence << "\n";
  }
  std::cout << out.path().string() << std::endl;
}
} // namespace

void exploreFile(const std::string &file, const std::string &out, unsigned int jobs, const std::string &commandLine,
                 const vpApp::Ranks &ranks)
{
  const auto start = std::chrono::steady_clock::now();
  std::string text;
  std::unique_ptr<vpApp::OutputFolder> folder;
  if (ranks.isFirst()) {
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
