/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "exploration.h"

#include "appMain.h"
#include "jobs.h"
#include "outcomeText.h"
#include "pareto.h"
#include "progress.h"

#include <algorithm>
#include <iostream>
#include <numeric>

namespace printExplore
{
namespace
{
//! Approximate cost of a design: images to render, and the stage between them. Any unit.
double effortOf(const Design &design, const Setup &setup)
{
  const Timing timing = timingOf(design, setup);
  if (!checkTiming(design, setup, timing).feasible()) {
    return 1.;
  }
  const double time = setup.task.cells * Lengths::pitchX * 1e-3 / (design.dropVelocity * design.speedUp);
  const double frames = time * design.frameRate + 120.;
  return 1. + (setup.task.runs + 0.4) * frames * (design.pixels() + 2000.);
}

Costs costsOf(const Outcome &outcome, const std::vector<std::string> &objectives)
{
  Costs costs;
  for (const std::string &name : objectives) {
    const Figure &figure = figureCalled(name);
    costs.push_back(figure.more ? -figure.of(outcome) : figure.of(outcome));
  }
  return costs;
}

bool keeps(const Outcome &outcome, const std::vector<Requirement> &requirements)
{
  return std::all_of(requirements.begin(), requirements.end(), [&](const Requirement &requirement) {
    const Figure &figure = figureCalled(requirement.figure);
    const double value = figure.of(outcome);
    return figure.more ? value >= requirement.bound : value <= requirement.bound;
  });
}

std::vector<Outcome> evaluateShare(const Setup &setup, const std::vector<std::size_t> &share, const Ranks &ranks,
                                   unsigned int jobs)
{
  double effort = 0.;
  for (const std::size_t index : share) {
    effort += effortOf(setup.designs[index], setup);
  }
  const auto style = ranks.rank() == 0 ? vpApp::Progress::detect() : vpApp::Progress::Style::Silent;
  vpApp::Progress progress("exploring " + std::to_string(setup.designs.size()) + " designs", std::max(1., effort),
                           std::cerr, style);
  std::vector<Outcome> outcomes(share.size());
  const unsigned int cores = std::max(1u, vpApp::coreCount() / static_cast<unsigned int>(ranks.local()));
  vpApp::runJobs(share.size(), jobs == 0 ? cores : jobs, [&](std::size_t k) {
    vpApp::throwIfInterrupted();
    outcomes[k] = evaluate(setup.designs[share[k]], share[k], setup, [] { return !vpApp::interrupted(); });
    progress.add(effortOf(setup.designs[share[k]], setup));
  });
  vpApp::throwIfInterrupted();
  return outcomes;
}
} // namespace

std::vector<std::vector<std::size_t>> shareOut(const Setup &setup, int ranks)
{
  std::vector<double> effort;
  for (const Design &design : setup.designs) {
    effort.push_back(effortOf(design, setup));
  }
  std::vector<std::size_t> order(effort.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return effort[a] > effort[b]; });
  std::vector<std::vector<std::size_t>> shares(static_cast<std::size_t>(ranks));
  std::vector<double> load(shares.size(), 0.);
  for (const std::size_t index : order) {
    const auto least = static_cast<std::size_t>(std::min_element(load.begin(), load.end()) - load.begin());
    shares[least].push_back(index);
    load[least] += effort[index];
  }
  return shares;
}

Exploration judge(const Setup &setup, std::vector<Outcome> outcomes)
{
  Exploration result;
  std::vector<std::size_t> eligible;
  std::vector<Costs> costs, choice;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    Outcome &outcome = outcomes[i];
    outcome.front = false;
    outcome.required = outcome.verdict.feasible() && keeps(outcome, setup.requirements);
    result.feasible += outcome.verdict.feasible() ? 1 : 0;
    if (outcome.required) {
      eligible.push_back(i);
      costs.push_back(costsOf(outcome, setup.objectives));
    }
  }
  result.required = eligible.size();
  for (const std::size_t k : paretoFront(costs)) {
    result.front.push_back(eligible[k]);
    outcomes[eligible[k]].front = true;
    choice.push_back(costs[k]);
  }
  if (!choice.empty()) {
    result.best = static_cast<std::ptrdiff_t>(result.front[compromise(choice)]);
  }
  result.outcomes = std::move(outcomes);
  return result;
}

Exploration explore(const Setup &setup, const Ranks &ranks, unsigned int jobs)
{
  const auto shares = shareOut(setup, ranks.size());
  const std::vector<std::size_t> &mine = shares[static_cast<std::size_t>(ranks.rank())];
  const std::vector<std::string> texts = ranks.gather(packed(evaluateShare(setup, mine, ranks, jobs)));
  if (ranks.rank() != 0) {
    return {};
  }
  std::vector<Outcome> outcomes(setup.designs.size());
  for (std::size_t rank = 0; rank < texts.size(); ++rank) {
    const std::vector<Outcome> part = unpacked(texts[rank], shares[rank], setup);
    for (std::size_t k = 0; k < part.size(); ++k) {
      outcomes[shares[rank][k]] = part[k];
    }
  }
  return judge(setup, std::move(outcomes));
}
} // namespace printExplore
