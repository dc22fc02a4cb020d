/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "exploration.h"

#include "appMain.h"
#include "outcomeText.h"
#include "pareto.h"

#include <algorithm>

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
} // namespace

vpApp::Sweep sweepOf(const Setup &setup)
{
  vpApp::Sweep sweep;
  sweep.title = "exploring " + std::to_string(setup.designs.size()) + " designs";
  sweep.count = setup.designs.size();
  sweep.effort = [&setup](std::size_t index) { return effortOf(setup.designs[index], setup); };
  return sweep;
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

Exploration explore(const Setup &setup, const vpApp::Ranks &ranks, unsigned int jobs)
{
  std::vector<Outcome> outcomes = vpApp::runSweep<Outcome>(
      ranks, sweepOf(setup), jobs, [&](std::size_t index, const std::function<void(double)> &) {
        return evaluate(setup.designs[index], index, setup, [] { return !vpApp::interrupted(); });
      });
  if (!ranks.isFirst()) {
    return {};
  }
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    outcomes[i].describe(setup.designs[i], setup);
  }
  return judge(setup, std::move(outcomes));
}
} // namespace printExplore
