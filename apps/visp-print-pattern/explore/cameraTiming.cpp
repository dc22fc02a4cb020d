/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "cameraTiming.h"

#include "numberText.h"

#include <algorithm>
#include <cmath>

namespace printExplore
{
namespace
{
using vpApp::number;

constexpr double longestDelay = 8.; // frames, maximum camera delay of vpPrintExperiment

//! Whole openings within a length of the product, in um: average and minimum.
double cellsAlong(double length, double pitch, double opening) { return std::max(0., length - opening) / pitch; }
} // namespace

Timing timingOf(const Design &design, const Setup &setup)
{
  const Camera &camera = setup.camera;
  const Processor &processor = setup.processor;
  Timing t;
  t.period = 1e6 / design.frameRate;
  t.readout = design.pixels() / camera.pixelRate;
  t.dataRate = design.pixels() * design.frameRate * 1e-6;
  const double along = cellsAlong(design.width * design.pixelSize, Lengths::pitchX, Lengths::openingX);
  const double across = cellsAlong(design.height * design.pixelSize, Lengths::pitchY, Lengths::openingY);
  t.cells = along * across;
  t.leastCells = static_cast<int>(std::floor(along)) * static_cast<int>(std::floor(across));
  const double pitchPixels = Lengths::pitchX * Lengths::pitchY / (design.pixelSize * design.pixelSize);
  const bool observed = design.controller == vpPrintController::Observer;
  t.computing = processor.frame + t.cells * (processor.cell + 1e-3 * processor.cellPixel * pitchPixels) +
                (observed ? processor.observer : processor.pid);
  t.load = t.computing / t.period;
  t.delay = 0.5 * design.exposure + t.readout + camera.interfaceTime + t.computing;
  t.delayFrames = t.delay / t.period;
  t.tracking = design.frameRate * Lengths::pitchX * 1e-3 / design.dropVelocity;
  const double area = std::pow(design.pixelSize / camera.lightPixel, 2);
  t.light = std::min(design.exposure / camera.lightExposure * area, camera.fullGrey / camera.bright);
  return t;
}

Verdict checkTiming(const Design &design, const Setup &setup, const Timing &timing)
{
  const Camera &camera = setup.camera;
  const std::string period = number(timing.period, 4) + " us of a frame";
  const double busy = camera.overlap ? std::max(design.exposure, timing.readout) : design.exposure + timing.readout;
  if (busy > timing.period) {
    return {"camera", "exposure of " + number(design.exposure, 4) + " us " + (camera.overlap ? "or" : "and") +
                          " readout of " + number(timing.readout, 4) + " us do not fit into the " + period};
  }
  if (timing.dataRate > camera.link) {
    return {"link", number(timing.dataRate, 4) + " MB/s exceed the link's " + number(camera.link, 4) + " MB/s"};
  }
  if (timing.load > setup.processor.maxLoad) {
    return {"processor", "computing takes " + number(timing.computing, 4) + " us of the " + period + ", a load of " +
                             number(timing.load, 3) + " cores where " + number(setup.processor.maxLoad, 3) +
                             " is allowed"};
  }
  if (timing.leastCells < setup.minCells) {
    return {"view", std::to_string(timing.leastCells) + " whole cells are in view at the worst instant, less than " +
                        std::to_string(setup.minCells)};
  }
  if (timing.delayFrames > longestDelay) {
    return {"delay", "the camera is " + number(timing.delayFrames, 3) + " frames late, more than the " +
                         number(longestDelay, 2) + " that are simulated"};
  }
  return {};
}
} // namespace printExplore
