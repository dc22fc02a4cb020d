/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"

#include "appMain.h"
#include "jobs.h"
#include "progress.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

namespace printPattern
{
namespace
{
constexpr int REPLICA_SEEDS = 8; // number of seeds used for the results of the design

vpPrintExperimentSpec observerOn(const vpPrintSensorModel &sensor)
{
  vpPrintExperimentSpec spec = vpPrintExperimentSpec::withObserver(sensor);
  spec.product.jitter = 0.3; // as in the thesis's experiments
  spec.cellsPerRow = 40;
  spec.frames = 120;
  return spec;
}

constexpr int SWINGS = 12;
constexpr int SWING_FRAMES = 160;   // a tenth of a second
constexpr double STRONGEST = 0.30;  // force, px/frame^2 at mass 1: up to about 8 px/frame
constexpr double WEAKEST = 0.10;    // hardly overcomes static friction
constexpr double FIFTH_CELL = 244.; // px: beyond it the stage has more friction, not covered by a constant model
constexpr int HALF_WINDOW = 6;      // frames; velocity and acceleration from a parabola over 2 n + 1 frames

// A parabola fitted to the positions of a window gives velocity and acceleration. The acceleration is a weighted mean
// over the window; the force is averaged with the same weights, or the mass estimate would be too small.
vpFrictionIdentification identify(const std::vector<double> &force, const std::vector<double> &place)
{
  constexpr int n = HALF_WINDOW;
  std::array<double, 2 * n + 1> second{}, mean{};
  double s2 = 0., s4 = 0.;
  for (int i = -n; i <= n; ++i) {
    s2 += i * i;
    s4 += std::pow(i, 4);
  }
  const double count = 2. * n + 1.;
  for (int i = -n; i <= n; ++i) {
    second[static_cast<std::size_t>(i + n)] = 2. * (i * i - s2 / count) / (s4 - s2 * s2 / count);
  }
  for (int j = -n; j <= n; ++j) { // double sum: effect of an acceleration at j on the later positions
    for (int i = j + 1; i <= n; ++i) {
      mean[static_cast<std::size_t>(j + n)] += second[static_cast<std::size_t>(i + n)] * (i - j);
    }
  }
  std::vector<vpFrictionSample> log;
  for (std::size_t k = n; k + n < place.size(); ++k) {
    vpFrictionSample sample;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const std::size_t at = k + i - n;
      sample.velocity += (static_cast<double>(i) - n) / s2 * place[at];
      sample.acceleration += second[i] * place[at];
      sample.force += mean[i] * force[at];
    }
    log.push_back(sample);
  }
  vpFrictionIdentificationSpec task;
  task.minVelocity = 0.15; // slower samples mix standstill and motion within the window
  return vpIdentifyFriction(log, task);
}

/*!
 * Drive the x axis in open loop with a slowly oscillating force of growing amplitude; measure the product's position in
 * each frame with the sensor error; smooth it, and identify.
 * \param spec : Stage, sensor model, seed.
 */
Identification identifyStage(const vpPrintExperimentSpec &spec)
{
  const vpXYStageAxis &axis = spec.stage.x;
  Identification result;
  result.truth.mass = axis.mass;
  result.truth.viscous = axis.viscous;
  result.truth.coulomb = axis.coulomb;
  result.truth.stiction = axis.stiction;
  result.truth.stribeckVelocity = axis.stribeckVelocity;
  result.frames = SWINGS * SWING_FRAMES;

  vpXYStage stage(spec.stage);
  // Start far on the near side, so that the oscillation stays in a region of constant friction.
  stage.reset({{std::min(0., axis.viscousRiseFrom) - 4. * FIFTH_CELL, 0.}});
  std::mt19937_64 random(spec.seed);
  std::normal_distribution<double> normal(0., spec.sensorModel.sigmaX / std::sqrt(spec.sensorModel.effectiveCells));
  std::vector<double> force, place;
  double acting = 0.;
  for (int k = 0; k < result.frames; ++k) {
    const double phase = 2. * M_PI * k / SWING_FRAMES, grown = static_cast<double>(k) / result.frames;
    const double command = (WEAKEST + grown * (STRONGEST - WEAKEST)) * std::sin(phase);
    place.push_back(stage.state().position[0] + normal(random));
    force.push_back(acting);
    stage.step(1., {{command, 0.}});
    acting = stage.state().force[0]; // known if the lag is known
  }
  result.found = identify(force, place);
  return result;
}

//! Use the identified model in observer, preview and feedforward. \throw std::runtime_error with the sentence of a
//! failure.
void useIdentified(const Identification &identification, vpPrintExperimentSpec &spec)
{
  const vpFrictionStatus status = identification.found.status;
  // A misfit is what overlapping windows give: the parameters hold.
  if (status != vpFrictionStatus::Good && status != vpFrictionStatus::NoStribeck &&
      status != vpFrictionStatus::Misfit) {
    throw std::runtime_error(std::string("--identify: ") + identification.found.message());
  }
  for (vpFrictionModel *model : {&spec.observer.model, &spec.preview.model, &spec.pid.model}) {
    *model = identification.found.model;
  }
}

//! Landing errors of some runs.
Landing landingOf(const std::vector<vpPrintRun> &runs)
{
  Landing landing;
  for (const vpPrintRun &run : runs) {
    for (const vpPrintDrop &drop : run.drops) {
      landing.errors.push_back(std::hypot(drop.errorX, drop.errorY));
    }
  }
  std::sort(landing.errors.begin(), landing.errors.end());
  if (!landing.errors.empty()) {
    landing.p50 = vpMedian(landing.errors);
    landing.p99 = vpQuantile(landing.errors, 0.99);
    landing.max = landing.errors.back();
    const auto end = std::upper_bound(landing.errors.begin(), landing.errors.end(), Landing::tolerance);
    landing.within = static_cast<double>(end - landing.errors.begin()) / static_cast<double>(landing.errors.size());
  }
  return landing;
}
} // namespace

double rmsOf(const std::vector<vpPrintRun> &runs, double vpPrintMetrics::*figure)
{
  double sum = 0.;
  for (const vpPrintRun &run : runs) {
    sum += std::pow(run.metrics.*figure, 2);
  }
  return runs.empty() ? 0. : std::sqrt(sum / static_cast<double>(runs.size()));
}

double meanOf(const std::vector<vpPrintRun> &runs, double vpPrintMetrics::*figure)
{
  double sum = 0.;
  for (const vpPrintRun &run : runs) {
    sum += run.metrics.*figure;
  }
  return runs.empty() ? 0. : sum / static_cast<double>(runs.size());
}

int sumOf(const std::vector<vpPrintRun> &runs, int vpPrintMetrics::*count)
{
  int sum = 0;
  for (const vpPrintRun &run : runs) {
    sum += run.metrics.*count;
  }
  return sum;
}

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
  return {make("7.12", "PID, step of the velocity", 0., vpPrintExperimentSpec::thesisStep()),
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

Results runAll(const Options &options)
{
  Results results;
  vpPrintExperimentSpec spec = options.spec;
  if (options.identify) {
    results.identification = identifyStage(spec);
    useIdentified(*results.identification, spec);
  }
  results.runs.resize(static_cast<std::size_t>(options.runs));
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    results.runs[i].spec = spec;
    results.runs[i].spec.seed += static_cast<unsigned int>(i);
    results.runs[i].spec.product.seed += static_cast<unsigned int>(i);
  }
  std::vector<Replica> replicas = options.replicas ? thesisReplicas() : std::vector<Replica>();
  std::vector<vpPrintRun *> jobs;
  for (vpPrintRun &run : results.runs) {
    jobs.push_back(&run);
  }
  for (Replica &replica : replicas) {
    for (vpPrintRun &run : replica.runs) {
      jobs.push_back(&run);
    }
  }
  {
    vpApp::Progress progress("printing", static_cast<double>(jobs.size()));
    vpApp::runJobs(jobs.size(), options.jobs == 0 ? vpApp::coreCount() : options.jobs, [&](std::size_t k) {
      double done = 0.;
      *jobs[k] = runPrintExperiment(jobs[k]->spec, [&](double share) {
        progress.add(std::max(0., share - done));
        done = std::max(done, share);
        return !vpApp::interrupted();
      });
      progress.add(1. - done);
    });
  }
  vpApp::throwIfInterrupted();
  results.landing = landingOf(results.runs);
  for (Replica &replica : replicas) {
    summarise(replica);
    (replica.figure.empty() ? results.observers : results.replicas).push_back(std::move(replica));
  }
  return results;
}
} // namespace printPattern
