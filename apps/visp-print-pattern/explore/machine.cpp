/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "machine.h"

#include "numberText.h"

#include "lab/printing/vpPrintUnits.h"

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

constexpr double basePixel = 4.5, baseRate = 1600.; // um, Hz: units of the machine description
constexpr double baseVelocity = 4.;                 // px/frame, for the reference's constants
constexpr double baseDelay = 1.28, hold = 0.5;      // frames: delay of the thesis's loop; delay of a held command
constexpr int runOut = 8;                           // cells after the last counted one
constexpr int runUp = 3;                            // cell times, for acceleration
constexpr double mostCommands = 56.;                // commands stored by the observer beyond the camera's delay

double pxPerFrame(double mmPerSecond) { return mmPerSecond * 1e3 / basePixel / baseRate; }

//! The machine in units of 4.5 um and 1/1600 s.
vpPrintExperimentSpec machineOf(const Design &design, const Setup &setup, const vpPrintSensorModel &sensor)
{
  vpPrintExperimentSpec spec = vpPrintExperimentSpec::withObserver(sensor);
  if (design.controller != vpPrintController::Observer) {
    const vpPrintExperimentSpec pid =
        vpPrintExperimentSpec::withPid(design.controller == vpPrintController::PidFeedforward);
    spec.controller = design.controller;
    spec.pid = pid.pid;
    spec.filter = pid.filter;
  }
  spec.dropVelocity = pxPerFrame(design.dropVelocity);
  spec.reference.meanVelocity = design.speedUp * spec.dropVelocity;
  const double faster = spec.dropVelocity / baseVelocity;
  spec.reference.freeze /= faster; // fraction of the time from cell to cell
  // Jerk grows with the cube of the velocity and lasts as long as a cell.
  spec.forecast.processNoise *= std::pow(faster, 5);
  const double bound = setup.maxAcceleration * 1e6 / basePixel / (baseRate * baseRate);
  spec.preview.maxForce = spec.previewAcross.maxForce = spec.pid.maxForce = bound;
  return spec;
}

void retune(vpPrintExperimentSpec &spec, const vpPrintUnits &units, double delay)
{
  const double lag = spec.preview.lag; // frames of the camera
  const double frames = delay + hold + lag;
  const double thesis = (baseDelay + hold) * units.frameRate / baseRate + lag;
  const vpPrintUnits slower{units.pixelSize, units.frameRate * frames / thesis};
  const double bound = spec.pid.maxForce;
  const vpFrictionModel model = spec.pid.model;
  spec.pid = vpInUnits(spec.pid, units, slower);
  spec.pid.maxForce = bound; // limit of the drives, not a tuning parameter
  spec.pid.model = model;
  spec.filter = vpInUnits(spec.filter, units, slower);
  spec.filterAhead *= frames / thesis;
}
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

vpProductPatternSpec productOf(const Design &design, const Setup &setup, const Timing &timing)
{
  const Camera &camera = setup.camera;
  const double px = 1. / design.pixelSize;
  vpProductPatternSpec product;
  product.width = design.width;
  product.height = design.height;
  product.pixelSize = design.pixelSize;
  product.pitchX = Lengths::pitchX * px;
  product.pitchY = Lengths::pitchY * px;
  product.openingX = Lengths::openingX * px;
  product.openingY = Lengths::openingY * px;
  product.cornerRadius = 20. * px;
  product.jitter = setup.task.jitter * px;
  product.flexAmplitudeX = product.flexAmplitudeY = setup.task.flex * px;
  product.flexPeriodX = product.flexPeriodY = setup.task.flexPeriod;
  product.psf = camera.blur * px;
  product.dark = camera.dark * timing.light;
  product.bright = camera.bright * timing.light;
  product.noise = camera.noise;
  product.exposure = design.exposure / timing.period;
  return product;
}

vpPrintExperimentSpec experimentOf(const Design &design, const Setup &setup, const Timing &timing,
                                   const vpPrintSensorModel &sensor)
{
  vpPrintSensorModel inBase = sensor;
  inBase.sigmaX *= design.pixelSize / basePixel;
  inBase.sigmaY *= design.pixelSize / basePixel;
  const vpPrintUnits units{design.pixelSize, design.frameRate};
  vpPrintExperimentSpec spec = vpInUnits(machineOf(design, setup, inBase), units);
  spec.product = productOf(design, setup, timing);
  spec.sensor = vpPrintSensor::Image;
  spec.visionDelay = timing.delayFrames;
  // A velocity control stops short of the last cell; a run 25 % too slow has failed.
  spec.cellsPerRow = setup.task.cells + setup.task.cells / 4 + runOut;
  const double cellTime = Lengths::pitchX * 1e-3 / (design.dropVelocity * design.speedUp); // s
  spec.frames = static_cast<int>(std::ceil(1.25 * (setup.task.cells + runUp) * cellTime * design.frameRate));
  while (spec.commandsPerFrame > 1 && spec.commandsPerFrame * (spec.visionDelay + 1.) > mostCommands) {
    spec.commandsPerFrame /= 2;
  }
  retune(spec, units, timing.delayFrames);
  return spec;
}
} // namespace printExplore
