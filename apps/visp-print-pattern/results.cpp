/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"
#include "thesisReplicas.h"

#include "appMain.h"
#include "jobs.h"
#include "progress.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace printPattern
{
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
