/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "arenaLog.h"

#include "numberText.h"
#include "options.h"

#include <ctime>
#include <numeric>

namespace planCompare
{
namespace
{
//! A property of a run: name, type and value.
struct Property {
  const char *name;
  double (*value)(const Record &);
};

double planningTime(const Record &r) { return std::accumulate(r.lookTimes.begin(), r.lookTimes.end(), r.planTime); }

const std::vector<Property> &properties()
{
  static const std::vector<Property> all = {
      {"clearance REAL", [](const Record &r) { return r.metrics.min_clearance_m; }},
      {"collisions moving INTEGER", [](const Record &r) { return double(r.metrics.collisions_moving); }},
      {"duration REAL", [](const Record &r) { return r.metrics.duration_s; }},
      {"false stops INTEGER", [](const Record &r) { return double(r.metrics.false_stops); }},
      {"goal error REAL", [](const Record &r) { return r.metrics.goal_error_m; }},
      {"jerk integral REAL", [](const Record &r) { return r.metrics.jerk_integral; }},
      {"path length REAL", [](const Record &r) { return r.metrics.path_length; }},
      {"peak a REAL", [](const Record &r) { return r.metrics.peak_a; }},
      {"peak jerk REAL", [](const Record &r) { return r.metrics.peak_jerk; }},
      {"peak v REAL", [](const Record &r) { return r.metrics.peak_v; }},
      {"replan p95 REAL", [](const Record &r) { return 1e-3 * r.metrics.replan_ms_p95; }},
      {"seed INTEGER", [](const Record &r) { return double(r.seed); }},
      {"solved BOOLEAN", [](const Record &r) { return r.metrics.success ? 1. : 0.; }},
      {"time REAL", planningTime},
  };
  return all;
}

//! Text as one word: spaces would end the name.
std::string word(const std::string &text) { return vpApp::fileName(text); }
} // namespace

std::string timeText()
{
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S", &utc);
  return text;
}

std::string arenaLog(const Plan &plan, const Results &results, const SceneInfo &scene, const std::string &startedAt)
{
  std::size_t runs = 0;
  double seconds = 0.;
  for (const std::string &method : plan.methods) {
    const Cell cell = results.cell(scene.id, method);
    runs = cell.runs.size();
    for (const Record *r : cell.runs) {
      seconds += planningTime(*r);
    }
  }
  std::string log = "OMPL version 1.5.2\nExperiment " + word("visp-plan-compare-" + scene.id) +
                    "\n0 experiment properties\nRunning on visp-direct-" + VISP_DIRECT_VERSION + "\nStarting at " +
                    startedAt + "\n<<<|\n" + scene.name + ": " + scene.sentence + "\n|>>>\n" +
                    "1 is the random seed\n20 seconds per run\n0 MB per run\n" + std::to_string(runs) +
                    " runs per planner\n" + vpApp::number(seconds, 6) +
                    " seconds spent to collect the data\n0 enum types\n" + std::to_string(plan.methods.size()) +
                    " planners\n";
  for (const std::string &method : plan.methods) {
    log +=
        word(method) + "\n0 common properties\n" + std::to_string(properties().size()) + " properties for each run\n";
    for (const Property &property : properties()) {
      log += std::string(property.name) + "\n";
    }
    log += std::to_string(runs) + " runs\n";
    for (const Record *r : results.cell(scene.id, method).runs) {
      for (const Property &property : properties()) {
        log += vpApp::number(property.value(*r), 10) + "; ";
      }
      log += "\n";
    }
    log += ".\n";
  }
  return log;
}
} // namespace planCompare
