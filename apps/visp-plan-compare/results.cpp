/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"

#include "appMain.h"
#include "sweep.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace planCompare
{
Interval wilson(int successes, int total)
{
  if (total <= 0) {
    return {};
  }
  constexpr double z = 1.959963984540054; // 97.5 % of the normal distribution
  const double n = total, p = successes / n, z2 = z * z;
  const double centre = (p + 0.5 * z2 / n) / (1. + z2 / n);
  const double half = z / (1. + z2 / n) * std::sqrt(p * (1. - p) / n + 0.25 * z2 / (n * n));
  return {successes == 0 ? 0. : centre - half, successes == total ? 1. : centre + half};
}

double mcNemar(int onlyFirst, int onlySecond)
{
  const int n = onlyFirst + onlySecond, few = std::min(onlyFirst, onlySecond);
  double p = 0.;
  for (int k = 0; k <= few; ++k) {
    p += std::exp(std::lgamma(n + 1.) - std::lgamma(k + 1.) - std::lgamma(n - k + 1.) - n * std::log(2.));
  }
  return std::min(1., 2. * p);
}

int Cell::successes() const
{
  return static_cast<int>(std::count_if(runs.begin(), runs.end(), [](const Record *r) { return r->metrics.success; }));
}

std::vector<double> Cell::values(Metric metric, bool successesOnly) const
{
  std::vector<double> list;
  for (const Record *r : runs) {
    if (r->metrics.success || !successesOnly) {
      list.push_back(r->metrics.*metric);
    }
  }
  return list;
}

int Cell::sum(Count count) const
{
  int total = 0;
  for (const Record *r : runs) {
    total += r->metrics.*count;
  }
  return total;
}

int Cell::runsWith(Count count) const
{
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [count](const Record *r) { return r->metrics.*count > 0; }));
}

std::vector<double> Cell::replanTimes() const
{
  std::vector<double> list;
  for (const Record *r : runs) {
    for (const double t : r->lookTimes) {
      list.push_back(1000. * t);
    }
  }
  return list;
}

Cell Results::cell(const std::string &scene, const std::string &method) const
{
  Cell cell;
  for (const Record &r : records) {
    if (r.scene == scene && r.method == method) {
      cell.runs.push_back(&r);
    }
  }
  return cell;
}

Cell Results::cell(const std::string &scene, const std::string &method, const std::string &variant) const
{
  Cell part = cell(scene, method);
  part.runs.erase(
      std::remove_if(part.runs.begin(), part.runs.end(), [&](const Record *r) { return r->variant != variant; }),
      part.runs.end());
  return part;
}

Cell Results::all(const std::string &method) const
{
  Cell cell;
  for (const Record &r : records) {
    if (r.method == method) {
      cell.runs.push_back(&r);
    }
  }
  return cell;
}

std::vector<std::string> Results::variants(const std::string &scene) const
{
  std::vector<std::string> list;
  for (const Record &r : records) {
    if (r.scene == scene && std::find(list.begin(), list.end(), r.variant) == list.end()) {
      list.push_back(r.variant);
    }
  }
  if (scene == "S3") {
    std::sort(list.begin(), list.end());
  }
  return list;
}

const vpAvoidanceRun *Results::find(const std::string &scene, const std::string &method) const
{
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (shownScenes[i] == scene && shown[i].spec.method == method) {
      return &shown[i];
    }
  }
  return nullptr;
}

Pairing pairUp(const Results &results, const std::string &scene, const std::string &first, const std::string &second)
{
  Pairing pairing;
  const Cell a = scene.empty() ? results.all(first) : results.cell(scene, first);
  const Cell b = scene.empty() ? results.all(second) : results.cell(scene, second);
  for (std::size_t i = 0; i < std::min(a.runs.size(), b.runs.size()); ++i) { // the same problems in the same order
    const bool x = a.runs[i]->metrics.success, y = b.runs[i]->metrics.success;
    ++(x ? (y ? pairing.both : pairing.onlyFirst) : (y ? pairing.onlySecond : pairing.neither));
  }
  pairing.p = mcNemar(pairing.onlyFirst, pairing.onlySecond);
  return pairing;
}

std::vector<std::pair<std::string, std::string>> pairsOf(const Plan &plan)
{
  const auto has = [&](const char *name) {
    return std::find(plan.methods.begin(), plan.methods.end(), name) != plan.methods.end();
  };
  std::vector<std::pair<std::string, std::string>> pairs;
  if (has("planner-dtg") && has("dtg-via")) {
    pairs.emplace_back("planner-dtg", "dtg-via");
  }
  return pairs;
}

Results runAll(const Plan &plan, const vpApp::Ranks &ranks, unsigned int jobs)
{
  const auto start = std::chrono::steady_clock::now();
  Results results;
  const std::size_t methods = plan.methods.size();
  std::vector<std::size_t> slots; // slots of the shown problems
  for (std::size_t i = 0; i < plan.problems.size(); ++i) {
    slots.push_back(results.shownScenes.size());
    if (plan.problems[i].shown) {
      results.shownScenes.insert(results.shownScenes.end(), methods, plan.problems[i].scene);
    }
  }
  results.shown.resize(results.shownScenes.size());

  vpApp::Sweep sweep;
  sweep.title = "running " + std::to_string(plan.problems.size() * methods) + " motions";
  sweep.count = plan.problems.size();
  sweep.onFirst = [&plan](std::size_t i) { return plan.problems[i].shown; };
  const auto solve = [&](std::size_t i, const std::function<void(double)> &done) {
    const Problem &problem = plan.problems[i];
    const vpAvoidanceScenario scenario = problem.make();
    std::vector<Record> records;
    for (std::size_t m = 0; m < methods; ++m) {
      vpAvoidanceRunSpec spec = scenario.run;
      spec.method = plan.methods[m];
      vpAvoidanceRun run = runAvoidanceExperiment(spec, [](double) { return !vpApp::interrupted(); });
      vpApp::throwIfInterrupted();
      records.push_back(
          {problem.scene, problem.variant, plan.methods[m], problem.seed, run.startTime, run.lookTimes, run.metrics});
      if (problem.shown) {
        results.shown[slots[i] + m] = std::move(run);
      }
      done(static_cast<double>(m + 1) / static_cast<double>(methods));
    }
    return records;
  };
  for (std::vector<Record> &records : vpApp::runSweep<std::vector<Record>>(ranks, sweep, jobs, solve)) {
    std::move(records.begin(), records.end(), std::back_inserter(results.records));
  }
  results.wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return results;
}
} // namespace planCompare
