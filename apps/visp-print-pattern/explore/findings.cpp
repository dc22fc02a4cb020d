/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "findings.h"

#include "numberText.h"

#include <algorithm>
#include <locale>
#include <sstream>

namespace printExplore
{
namespace
{
using vpApp::fixed;
using vpApp::number;

//! Designs that meet the requirements, are at least as good in all objectives and better in one.
std::size_t betterThan(const Setup &setup, const Exploration &result, const Outcome &one)
{
  const Costs costs = costsOf(one, setup.objectives);
  return static_cast<std::size_t>(
      std::count_if(result.outcomes.begin(), result.outcomes.end(), [&](const Outcome &other) {
        return other.required && dominates(costsOf(other, setup.objectives), costs);
      }));
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

//! "95 % of the drops within 0.31 um, worst 0.40 um, 163.6 cells/s, 2.7 % of a core".
std::string figuresText(const Outcome &outcome)
{
  return "95 % of the drops within " + number(outcome.landing95, 3) + " um, the worst " +
         number(outcome.landingWorst, 3) + " um off, " + fixed(outcome.throughput, 1) + " cells/s, " +
         number(100. * outcome.timing.load, 2) + " % of a core";
}

using Json = nlohmann::ordered_json;

//! \brief A column of the CSV: its name and value. Texts in quotes.
struct Column {
  const char *name;
  Json (*of)(const Outcome &);
};

const std::vector<Column> &columns()
{
  static const std::vector<Column> all = {
      {"frame_rate_hz", [](const Outcome &o) -> Json { return o.design.frameRate; }},
      {"width_px", [](const Outcome &o) -> Json { return o.design.width; }},
      {"height_px", [](const Outcome &o) -> Json { return o.design.height; }},
      {"um_per_px", [](const Outcome &o) -> Json { return o.design.pixelSize; }},
      {"exposure_us", [](const Outcome &o) -> Json { return o.design.exposure; }},
      {"controller", [](const Outcome &o) -> Json { return nameOf(o.design.controller); }},
      {"drop_velocity_mm_s", [](const Outcome &o) -> Json { return o.design.dropVelocity; }},
      {"speed_up", [](const Outcome &o) -> Json { return o.design.speedUp; }},
      {"readout_us", [](const Outcome &o) -> Json { return o.timing.readout; }},
      {"computing_us", [](const Outcome &o) -> Json { return o.timing.computing; }},
      {"delay_us", [](const Outcome &o) -> Json { return o.timing.delay; }},
      {"delay_frames", [](const Outcome &o) -> Json { return o.timing.delayFrames; }},
      {"data_rate_mb_s", [](const Outcome &o) -> Json { return o.timing.dataRate; }},
      {"cells_in_view", [](const Outcome &o) -> Json { return o.timing.cells; }},
      {"least_cells_in_view", [](const Outcome &o) -> Json { return o.timing.leastCells; }},
      {"nf_m", [](const Outcome &o) -> Json { return o.timing.tracking; }},
      {"light", [](const Outcome &o) -> Json { return o.timing.light; }},
      {"load", [](const Outcome &o) -> Json { return o.timing.load; }},
      {"sensor_x_um", [](const Outcome &o) -> Json { return o.sensorX; }},
      {"sensor_y_um", [](const Outcome &o) -> Json { return o.sensorY; }},
      {"landing_rms_um", [](const Outcome &o) -> Json { return o.landingRms; }},
      {"landing_p95_um", [](const Outcome &o) -> Json { return o.landing95; }},
      {"landing_worst_um", [](const Outcome &o) -> Json { return o.landingWorst; }},
      {"cells", [](const Outcome &o) -> Json { return o.cells; }},
      {"missed", [](const Outcome &o) -> Json { return o.missed; }},
      {"doubled", [](const Outcome &o) -> Json { return o.doubled; }},
      {"throughput_cells_per_s", [](const Outcome &o) -> Json { return o.throughput; }},
      {"feasible", [](const Outcome &o) -> Json { return o.verdict.feasible() ? 1 : 0; }},
      {"required", [](const Outcome &o) -> Json { return o.required ? 1 : 0; }},
      {"front", [](const Outcome &o) -> Json { return o.front ? 1 : 0; }},
      {"thesis", [](const Outcome &o) -> Json { return o.thesis ? 1 : 0; }},
      {"reason", [](const Outcome &o) -> Json { return o.verdict.kind; }},
      {"sentence", [](const Outcome &o) -> Json { return o.verdict.sentence; }}};
  return all;
}

std::string field(const Json &value)
{
  if (!value.is_string()) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(10);
    text << value.get<double>();
    return text.str();
  }
  const std::string content = value.get<std::string>();
  return content.find(',') == std::string::npos ? content : '"' + content + '"'; // our sentences have no quotes
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

std::string exploreCsv(const Exploration &result, bool frontOnly)
{
  std::string text = "design";
  for (const Column &column : columns()) {
    text += std::string(",") + column.name;
  }
  text += "\n";
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    const Outcome &outcome = result.outcomes[i];
    if (frontOnly && !outcome.front) {
      continue;
    }
    text += std::to_string(i);
    for (const Column &column : columns()) {
      text += "," + field(column.of(outcome));
    }
    text += "\n";
  }
  return text;
}

Json jsonOf(const Outcome &outcome)
{
  Json json;
  for (const Column &column : columns()) {
    json[column.name] = column.of(outcome);
  }
  return json;
}

Json summaryOf(const Setup &setup, const Exploration &result, const std::string &commandLine, double wallTime)
{
  Json reasons = Json::object(), front = Json::array(), thesis = Json::array(), required = Json::object();
  for (const auto &[kind, count] : reasonsOf(result)) {
    reasons[kind] = count;
  }
  for (const std::size_t index : result.front) {
    front.push_back(index);
  }
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    if (result.outcomes[i].thesis) {
      thesis.push_back({{"design", i}, {"figures", jsonOf(result.outcomes[i])}});
    }
  }
  for (const Requirement &requirement : setup.requirements) {
    required[requirement.figure] = requirement.bound;
  }
  Json summary = {{"version", VISP_DIRECT_VERSION},
                  {"command", commandLine},
                  {"name", setup.name},
                  {"designs", result.outcomes.size()},
                  {"feasible", result.feasible},
                  {"infeasible", reasons},
                  {"require", required},
                  {"keep_what_is_required", result.required},
                  {"objectives", setup.objectives},
                  {"front", front},
                  {"findings", findingsOf(setup, result)},
                  {"thesis", thesis}};
  if (result.best >= 0) {
    summary["best"] = {{"design", result.best},
                       {"figures", jsonOf(result.outcomes[static_cast<std::size_t>(result.best)])}};
  }
  summary["wall_time_s"] = wallTime;
  return summary;
}
} // namespace printExplore
