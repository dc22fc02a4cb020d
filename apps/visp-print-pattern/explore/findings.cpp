/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "findings.h"

#include "numberText.h"
#include "pareto.h"

#include <algorithm>

namespace printExplore
{
namespace
{
using vpApp::fixed;
using vpApp::number;

//! Designs that meet the requirements, are at least as good in all objectives and better in one.
std::size_t betterThan(const Setup &setup, const Exploration &result, const Outcome &one)
{
  const auto costs = [&](const Outcome &outcome) {
    Costs all;
    for (const std::string &name : setup.objectives) {
      const Figure &figure = figureCalled(name);
      all.push_back(figure.more ? -figure.of(outcome) : figure.of(outcome));
    }
    return all;
  };
  return static_cast<std::size_t>(
      std::count_if(result.outcomes.begin(), result.outcomes.end(),
                    [&](const Outcome &other) { return other.required && dominates(costs(other), costs(one)); }));
}

std::string requirementsText(const Setup &setup)
{
  std::vector<std::string> parts;
  for (const Requirement &requirement : setup.requirements) {
    const Figure &figure = figureCalled(requirement.figure);
    parts.push_back(std::string(figure.name) + (figure.more ? " >= " : " <= ") + number(requirement.bound, 4));
  }
  return vpApp::enumerate(parts);
}

std::string plural(std::size_t count, const std::string &noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}
} // namespace

std::map<std::string, std::size_t> reasonsOf(const Exploration &result)
{
  std::map<std::string, std::size_t> reasons;
  for (const Outcome &outcome : result.outcomes) {
    if (!outcome.verdict.feasible()) {
      ++reasons[outcome.verdict.kind];
    }
  }
  return reasons;
}

std::string meaningOf(const std::string &kind)
{
  static const std::map<std::string, std::string> meanings = {
      {"camera", "exposure and readout do not fit into a frame"},
      {"link", "the images do not fit through the link"},
      {"processor", "computing takes longer than is allowed"},
      {"view", "too few whole cells in view"},
      {"delay", "the camera is too many frames late to be simulated"},
      {"tracker", "the tracker does not find or hold the product"},
      {"cells", "cells get no drop in time, or more than one"},
      {"model", "a length or gain is out of the range of the modules"}};
  const auto found = meanings.find(kind);
  return found == meanings.end() ? kind : found->second;
}

std::string figuresText(const Outcome &outcome)
{
  return "95 % of the drops within " + number(outcome.landing95, 3) + " um, the worst " +
         number(outcome.landingWorst, 3) + " um off, " + fixed(outcome.throughput, 1) + " cells/s, " +
         number(100. * outcome.timing.load, 2) + " % of a core";
}

std::vector<std::string> findingsOf(const Setup &setup, const Exploration &result)
{
  const std::string required = requirementsText(setup);
  const std::string kept =
      required.empty() ? ""
                       : ", " + std::to_string(result.required) + " of these keep what is required (" + required + ")";
  std::vector<std::string> sentences = {"Of " + plural(result.outcomes.size(), "design") + " " +
                                        std::to_string(result.feasible) + " work" + kept + ", and " +
                                        std::to_string(result.front.size()) + " are on the Pareto front."};
  if (result.best >= 0) {
    const Outcome &best = result.outcomes[static_cast<std::size_t>(result.best)];
    sentences.push_back("The best compromise is " + textOf(best.design) + ": " + figuresText(best) + ".");
  }
  else {
    sentences.push_back(required.empty() ? "None works, so there is nothing to choose."
                                         : "No design that works keeps what is required.");
  }
  for (const Outcome &outcome : result.outcomes) {
    if (!outcome.thesis) {
      continue;
    }
    const std::string camera = "The thesis's camera and velocity with " + nameOf(outcome.design.controller);
    if (!outcome.verdict.feasible()) {
      sentences.push_back(camera + " do not work here: " + outcome.verdict.sentence + ".");
      continue;
    }
    std::string place = "on the front";
    if (!outcome.required) {
      place = "this does not keep what is required";
    }
    else if (!outcome.front) {
      place = plural(betterThan(setup, result, outcome), "design") +
              " at least as good in every objective and better in one";
    }
    sentences.push_back(camera + ": " + figuresText(outcome) + "; " + place + ".");
  }
  return sentences;
}
} // namespace printExplore
