/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"
#include "lab/printing/vpPrintExperiment.h"
#include "lab/printing/vpPrintFit.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the print experiment");

vpPrintFit::Figures thesisFigures() { return vpPrintFit::figuresOf(vpPrintFit::stored(), vpPrintFit::storedPoor); }
} // namespace

vpPrintSensorModel vpPrintSensorModel::thesis() { return vpPrintSensorModel(); }

vpPrintSensorModel vpPrintSensorModel::tracker()
{
  vpPrintSensorModel sensor;
  sensor.sigmaX = 0.0153;
  sensor.sigmaY = 0.0078;
  sensor.effectiveCells = 10.;
  return sensor;
}

vpPrintExperimentSpec vpPrintExperimentSpec::withPid(bool feedforward)
{
  vpPrintExperimentSpec spec;
  spec.controller = feedforward ? vpPrintController::PidFeedforward : vpPrintController::Pid;
  spec.pid = feedforward ? vpPrintVelocityControlSpec::thesisFeedforward() : vpPrintVelocityControlSpec::thesisPid();
  if (feedforward) {
    spec.filter = {0.19, 1.17};
  }
  return spec;
}

vpPrintExperimentSpec vpPrintExperimentSpec::thesisStep() { return thesisFigures().step; }
vpPrintExperimentSpec vpPrintExperimentSpec::thesisPid() { return thesisFigures().pid; }
vpPrintExperimentSpec vpPrintExperimentSpec::thesisFeedforward() { return thesisFigures().feedforward; }
vpPrintExperimentSpec vpPrintExperimentSpec::thesisPoorFilter() { return thesisFigures().poor; }

vpPrintExperimentSpec vpPrintExperimentSpec::withObserver(const vpPrintSensorModel &sensor)
{
  vpPrintExperimentSpec spec;
  spec.sensorModel = sensor;
  spec.product.noise = 4.;
  spec.controller = vpPrintController::Observer;
  spec.observer.model.viscous = 0.02;
  spec.observer.model.coulomb = 0.08;
  spec.observer.model.stiction = 0.12;
  spec.observer.model.stribeckVelocity = 0.3;
  spec.preview.model = spec.observer.model;
  spec.preview.velocityGain = 0.7;
  spec.preview.positionGain = 0.03;
  spec.previewAcross = spec.preview; // stiff, against stiction
  spec.previewAcross.velocityGain = 0.8;
  spec.previewAcross.positionGain = 0.25;
  spec.commandsPerFrame = 4;
  const bool fine = sensor.sigmaX / std::sqrt(sensor.effectiveCells) < 0.03;
  // A coarse sensor needs a slow filter, which would learn too late where the friction rises. A fine one sees the
  // errors of the friction model instead and would treat everything as a change.
  spec.observer.disturbanceNoise = fine ? 1e-7 : 3e-7;
  spec.observer.changeRate = fine ? 0. : 0.003;
  spec.observer.velocityNoise = 1e-6;
  return spec;
}

void vpPrintExperimentSpec::validate() const
{
  vpPrintMachineSpec::validate();
  stage.validate();
  product.validate();
  fields.positive("sigmaX", sensorModel.sigmaX);
  fields.positive("sigmaY", sensorModel.sigmaY);
  fields.in("effectiveCells", sensorModel.effectiveCells, {1});
  fields.in("captureJitter", captureJitter, {0., 2.});
  fields.in("dropped", dropped, {0., 0.5});
  fields.finite("nozzleOffset", nozzleOffset);
  fields.in("frames", frames, {0});
  fields.in("evaluateFrom", evaluateFrom, {0});
  fields.positive("frameRate", frameRate);
  fields.require(stageParts >= commandsPerFrame && stageParts <= 32 && 32 % std::max(1, stageParts) == 0, "stageParts",
                 stageParts, "a power of 2 from commandsPerFrame to 32");
  fields.require(product.rotation == 0., "rotation", product.rotation, "0: the axes of stage and product are the same");
}

END_VISP_NAMESPACE
