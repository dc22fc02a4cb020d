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
#include <numeric>

namespace servoCompare
{
namespace
{
//! Expected cost of a run relative to one with points: rendering and vision take most of the time.
double costOf(const vpServoRunSpec &spec) { return spec.measure == "image" ? 2. * spec.plant.visionRate : 1.; }

bool matches(const vpServoRunSpec &spec, const std::string &law, const std::string &plant, const std::string &measure,
             Command command)
{
  return spec.law == law && spec.plant.name == plant && spec.measure == measure &&
         spec.shape.has_value() == (command == Command::Shaped);
}
} // namespace

std::vector<double> Results::values(const std::string &law, const std::string &plant, const std::string &measure,
                                    Metric metric, Command command) const
{
  std::vector<double> list;
  for (const vpServoRun &run : m_runs) {
    if (matches(run.spec, law, plant, measure, command)) {
      list.push_back(run.metrics.*metric);
    }
  }
  return list;
}

std::optional<Spread> Results::spread(const std::string &law, const std::string &plant, const std::string &measure,
                                      Metric metric, Command command) const
{
  const std::vector<double> list = values(law, plant, measure, metric, command);
  if (list.empty()) {
    return std::nullopt;
  }
  return Spread{vpMedian(list), vpQuantile(list, 0.), vpQuantile(list, 1.)};
}

const vpServoRun *Results::find(const std::string &law, const std::string &plant, const std::string &measure,
                                Command command) const
{
  for (const vpServoRun &run : m_runs) {
    if (matches(run.spec, law, plant, measure, command)) {
      return &run;
    }
  }
  return nullptr;
}

Results runAll(const Plan &plan, const std::string &targetFile, unsigned int jobs,
               const std::function<void(const vpServoRun &)> &finished)
{
  std::vector<std::size_t> order(plan.runs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costOf(plan.runs[a]) > costOf(plan.runs[b]); });
  double total = 0.;
  for (const vpServoRunSpec &spec : plan.runs) {
    total += costOf(spec);
  }

  Results results(plan.runs.size());
  vpApp::Progress progress("simulating " + std::to_string(plan.runs.size()) + " runs", total);
  vpApp::runJobs(order.size(), jobs, [&](std::size_t i) {
    vpServoRunSpec spec = plan.runs[order[i]];
    spec.target = targetFile;
    double shown = 0.;
    vpServoRun run = runServoExperiment(spec, [&](double share) {
      progress.add((share - shown) * costOf(spec));
      shown = share;
      return !vpApp::interrupted();
    });
    vpApp::throwIfInterrupted();
    progress.add((1. - shown) * costOf(spec));
    if (spec.seed == plan.seed) {
      finished(run);
    }
    else {
      run.samples = {};
      run.arm = {};
    }
    results.set(order[i], std::move(run));
  });
  return results;
}
} // namespace servoCompare
