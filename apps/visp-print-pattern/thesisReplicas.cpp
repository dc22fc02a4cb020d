/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "thesisReplicas.h"

namespace printPattern
{
namespace
{
constexpr int REPLICA_SEEDS = 8; // number of seeds used for the results of the design

//! Figure 7.12: a velocity step, PID.
vpPrintExperimentSpec stepResponse()
{
  vpPrintExperimentSpec spec = vpPrintExperimentSpec::thesisPid();
  spec.reference.mode = vpPrintReferenceMode::ConstantVelocity;
  spec.cellsPerRow = 60;
  spec.frames = 480; // 0.3 s
  return spec;
}

vpPrintExperimentSpec observerOn(const vpPrintSensorModel &sensor)
{
  vpPrintExperimentSpec spec = vpPrintExperimentSpec::withObserver(sensor);
  spec.product.jitter = 0.3; // as in the thesis's experiments
  spec.cellsPerRow = 40;
  spec.frames = 120;
  return spec;
}
} // namespace

std::vector<Replica> thesisReplicas()
{
  const auto make = [](const char *figure, const char *name, double thesis, const vpPrintExperimentSpec &spec) {
    Replica replica;
    replica.figure = figure;
    replica.name = name;
    replica.thesis = thesis;
    replica.runs.resize(REPLICA_SEEDS);
    unsigned int seed = 0;
    for (vpPrintRun &run : replica.runs) {
      run.spec = spec;
      run.spec.seed = run.spec.product.seed = ++seed;
    }
    return replica;
  };
  return {make("7.12", "PID, step of the velocity", 0., stepResponse()),
          make("7.13", "PID", 0.57, vpPrintExperimentSpec::thesisPid()),
          make("7.14", "PID and feedforward", 0.40, vpPrintExperimentSpec::thesisFeedforward()),
          make("7.15", "PID, poorly tuned filter", 0.64, vpPrintExperimentSpec::thesisPoorFilter()),
          make("", "Observer, the thesis's sensor", 0., observerOn(vpPrintSensorModel::thesis())),
          make("", "Observer, our tracker", 0., observerOn(vpPrintSensorModel::tracker()))};
}

void summarise(Replica &replica)
{
  replica.rms_velocity_error = rmsOf(replica.runs, &vpPrintMetrics::rms_velocity_error);
  replica.centre_velocity_error = rmsOf(replica.runs, &vpPrintMetrics::centre_velocity_error);
}
} // namespace printPattern
