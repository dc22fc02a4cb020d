/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "exploration.h"

#include "appMain.h"

#include <algorithm>
#include <cmath>
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

bool keeps(const Outcome &outcome, const std::vector<Requirement> &requirements)
{
  return std::all_of(requirements.begin(), requirements.end(), [&](const Requirement &requirement) {
    const Figure &figure = figureCalled(requirement.figure);
    const double value = figure.of(outcome);
    return figure.more ? value >= requirement.bound : value <= requirement.bound;
  });
}
} // namespace

bool dominates(const Costs &a, const Costs &b)
{
  bool better = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) {
      return false;
    }
    better = better || a[i] < b[i];
  }
  return better;
}

std::vector<std::size_t> paretoFront(const std::vector<Costs> &points)
{
  // In lexicographic order only earlier points can dominate a point, and by transitivity those of the front suffice.
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const bool beaten =
        std::any_of(front.begin(), front.end(), [&](std::size_t other) { return dominates(points[other], points[i]); });
    if (!beaten) {
      front.push_back(i);
    }
  }
  std::sort(front.begin(), front.end());
  return front;
}

std::size_t compromise(const std::vector<Costs> &points)
{
  Costs least = points.front(), most = points.front();
  for (const Costs &point : points) {
    for (std::size_t i = 0; i < point.size(); ++i) {
      least[i] = std::min(least[i], point[i]);
      most[i] = std::max(most[i], point[i]);
    }
  }
  const auto distance = [&](const Costs &point) {
    double sum = 0.;
    for (std::size_t i = 0; i < point.size(); ++i) {
      const double range = most[i] - least[i];
      sum += range > 0. ? std::pow((point[i] - least[i]) / range, 2) : 0.;
    }
    return sum;
  };
  const auto best = std::min_element(points.begin(), points.end(),
                                     [&](const Costs &a, const Costs &b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(best - points.begin());
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
