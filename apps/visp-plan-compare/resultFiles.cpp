/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "resultFiles.h"

#include "findings.h"

#include "appMain.h"
#include "numberText.h"
#include "runData.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <ctime>
#include <numeric>

namespace planCompare
{
namespace
{
using Json = nlohmann::ordered_json;

constexpr std::size_t SELF_MOTION_STEP = 4; // samples; more would not be visible

//! Median, 5th and 95th percentiles over the runs.
Json spread(const std::vector<double> &values)
{
  return {{"median", vpMedian(values)}, {"p5", vpQuantile(values, 0.05)}, {"p95", vpQuantile(values, 0.95)}};
}

Json cellJson(const SceneInfo &scene, const std::string &method, const Cell &cell)
{
  using M = vpAvoidanceMetrics;
  const Interval interval = cell.interval();
  const std::vector<double> replan = cell.replanTimes(), clearance = cell.values(&M::min_clearance_m, false);
  std::vector<double> plan;
  for (const Record *r : cell.runs) {
    plan.push_back(1000. * r->planTime);
  }
  return {{"scene", scene.id},
          {"method", method},
          {"runs", cell.runs.size()},
          {"successes", cell.successes()},
          {"success", cell.runs.empty() ? 0. : double(cell.successes()) / double(cell.runs.size())},
          {"success_wilson_95", {interval.low, interval.high}},
          {"min_clearance_m", clearance.empty() ? 0. : *std::min_element(clearance.begin(), clearance.end())},
          {"clearance_m", spread(clearance)},
          {"goal_error_m", spread(cell.values(&M::goal_error_m, false))},
          {"duration_s", spread(cell.values(&M::duration_s, true))},
          {"peak_v", spread(cell.values(&M::peak_v, false))},
          {"peak_a", spread(cell.values(&M::peak_a, false))},
          {"peak_jerk", spread(cell.values(&M::peak_jerk, false))},
          {"jerk_integral", spread(cell.values(&M::jerk_integral, true))},
          {"path_length", spread(cell.values(&M::path_length, true))},
          {"plan_ms", {{"p50", vpQuantile(plan, .5)}, {"p95", vpQuantile(plan, .95)}, {"p99", vpQuantile(plan, .99)}}},
          {"replan_ms",
           {{"p50", vpQuantile(replan, .5)}, {"p95", vpQuantile(replan, .95)}, {"p99", vpQuantile(replan, .99)}}},
          {"stops", cell.sum(&M::stops)},
          {"false_stops", cell.sum(&M::false_stops)},
          {"runs_with_collision_moving", cell.runsWith(&M::collisions_moving)},
          {"runs_with_collision_standing", cell.runsWith(&M::collisions_standing)},
          {"runs_over_joint_velocity", cell.runsWith(&M::joint_v_violations)},
          {"runs_over_joint_acceleration", cell.runsWith(&M::joint_a_violations)},
          {"runs_over_tool_velocity", cell.runsWith(&M::tool_v_violations)},
          {"runs_over_tool_acceleration", cell.runsWith(&M::tool_a_violations)}};
}

//! Description of the shown run of a scene: "right to left, seed 1".
std::string whichRun(const Plan &plan, const std::string &scene)
{
  for (const Problem &problem : plan.problems) {
    if (problem.scene == scene && problem.shown) {
      return (problem.variant.empty() ? "" : problem.variant + ", ") + "seed " + std::to_string(problem.seed);
    }
  }
  return "";
}

Json sceneJson(const Plan &plan, const Results &results, const SceneInfo &scene)
{
  return {{"id", scene.id},
          {"name", scene.name},
          {"sentence", scene.sentence},
          {"shown", whichRun(plan, scene.id)},
          {"best", heroOf(plan, results, scene.id)},
          {"findings", findingsOf(plan, results, scene)}};
}

Json methodJson(const Plan &plan, const Results &results, const std::string &method)
{
  const MethodInfo info = methodInfo(method);
  return {{"id", info.id}, {"sentence", info.sentence}, {"verdict", verdictOf(plan, results, method)}};
}

//! Of the loop and the tool, the same in all runs; null without runs.
Json limitsJson(const Results &results)
{
  if (results.shown.empty()) {
    return nullptr;
  }
  const vpAvoidanceRunSpec &spec = results.shown.front().spec;
  return {{"max_velocity_mps", spec.methodSpec.maxVelocity},
          {"max_acceleration_mps2", spec.methodSpec.maxAcceleration},
          {"goal_tolerance_m", spec.goalTolerance}};
}

Json logsJson(const Results &results)
{
  Json logs = Json::array();
  for (std::size_t i = 0; i < results.shown.size(); ++i) {
    const std::string &method = results.shown[i].spec.method;
    logs.push_back({{"scene", results.shownScenes[i]},
                    {"method", method},
                    {"file", logName(results.shownScenes[i], method)},
                    {"scene_file", sceneName(results.shownScenes[i])}});
  }
  return logs;
}

Json pairJson(const Results &results, const std::string &scene, const std::pair<std::string, std::string> &pair)
{
  const Pairing p = pairUp(results, scene, pair.first, pair.second);
  return {{"scene", scene.empty() ? "all" : scene},
          {"first", pair.first},
          {"second", pair.second},
          {"both", p.both},
          {"only_first", p.onlyFirst},
          {"only_second", p.onlySecond},
          {"neither", p.neither},
          {"mcnemar_exact_p", p.p}};
}
} // namespace

Json summaryOf(const Plan &plan, const Results &results, const Extras &extras)
{
  Json cells = Json::array(), variants = Json::array(), pairs = Json::array(), scenes = Json::array(),
       methods = Json::array();
  for (const std::string &method : plan.methods) {
    methods.push_back(methodJson(plan, results, method));
  }
  for (const SceneInfo &scene : plan.scenes) {
    const std::vector<std::string> parts = results.variants(scene.id);
    scenes.push_back(sceneJson(plan, results, scene));
    for (const std::string &method : plan.methods) {
      cells.push_back(cellJson(scene, method, results.cell(scene.id, method)));
      for (const std::string &variant : parts.size() > 1 ? parts : std::vector<std::string>()) {
        variants.push_back(cellJson(scene, method, results.cell(scene.id, method, variant)));
        variants.back()["variant"] = variant;
      }
    }
    for (const auto &pair : pairsOf(plan)) {
      pairs.push_back(pairJson(results, scene.id, pair));
    }
  }
  for (const auto &pair : pairsOf(plan)) {
    pairs.push_back(pairJson(results, "", pair));
  }
  Json validators = Json::array(), selfMotion = Json::array();
  for (const ValidatorRow &row : extras.validators) {
    validators.push_back({{"scene", row.scene},
                          {"planner", row.planner},
                          {"validator", row.validator},
                          {"plans", row.plans},
                          {"solved", row.solved},
                          {"planning_ms_p50", row.p50},
                          {"planning_ms_p95", row.p95},
                          {"length_rad_p50", row.length},
                          {"colliding_at_10000_places", row.colliding}});
  }
  for (const SelfMotionRow &row : extras.selfMotion) {
    selfMotion.push_back({{"index", row.index},
                          {"sense", row.sense},
                          {"share", row.share},
                          {"tcp_drift_m", row.run.tcp_drift_m},
                          {"tcp_drift_rad", row.run.tcp_drift_rad},
                          {"start_distance_m", row.run.start_distance_m},
                          {"mean_distance_m", row.run.mean_distance_m},
                          {"end_distance_m", row.run.end_distance_m},
                          {"joint_travel_rad", row.run.joint_travel_rad}});
  }
  return {{"program", "visp-plan-compare"},
          {"version", vpApp::versionText()},
          {"command_line", extras.commandLine},
          {"wall_time_s", extras.wallTime},
          {"data", "simulated arm, sensors and obstacles"},
          {"arm", plan.arm->label()},
          {"remarks", plan.remarks},
          {"answer", answerOf(plan, results)},
          {"methods", methods},
          {"scenes", scenes},
          {"problems", plan.problems.size()},
          {"results", cells},
          {"variants", variants},
          {"pairs", pairs},
          {"self_motion", selfMotion},
          {"self_motion_finding", selfMotionFinding(extras.selfMotion)},
          {"self_motion_sentence", selfMotionSentence()},
          {"validators", validators},
          {"validator_finding", validatorFinding(extras.validators)},
          {"logs", logsJson(results)},
          {"limits", limitsJson(results)}};
}

std::string runsCsv(const Results &results)
{
  std::string csv = "scene,variant,seed,method,success,min_clearance_m,goal_error_m,duration_s,peak_v,peak_a,peak_jerk,"
                    "jerk_integral,path_length,replan_ms_p50,replan_ms_p95,replan_ms_p99,plan_ms,stops,false_stops,"
                    "collisions_moving,collisions_standing,joint_v_violations,joint_a_violations,tool_v_violations,"
                    "tool_a_violations,status\n";
  for (const Record &r : results.records) {
    const vpAvoidanceMetrics &m = r.metrics;
    vpApp::CsvRow row;
    row << r.scene << r.variant << r.seed << r.method.c_str() << m.success << m.min_clearance_m << m.goal_error_m
        << m.duration_s << m.peak_v << m.peak_a << m.peak_jerk << m.jerk_integral << m.path_length << m.replan_ms_p50
        << m.replan_ms_p95 << m.replan_ms_p99 << 1000. * r.planTime << m.stops << m.false_stops << m.collisions_moving
        << m.collisions_standing << m.joint_v_violations << m.joint_a_violations << m.tool_v_violations
        << m.tool_a_violations << m.status;
    csv += row.line();
  }
  return csv;
}

std::string selfMotionCsv(const std::vector<SelfMotionRow> &rows)
{
  std::string csv = "index,sense,share,time_s,distance_m\n";
  for (const SelfMotionRow &row : rows) {
    for (std::size_t i = 0; i < row.run.samples.size(); i += SELF_MOTION_STEP) {
      vpApp::CsvRow line;
      line << row.index.c_str() << row.sense.c_str() << row.share << row.run.samples[i].time
           << row.run.samples[i].distance;
      csv += line.line();
    }
  }
  return csv;
}

std::string logName(const std::string &scene, const std::string &method)
{
  return "log/" + vpApp::fileName(scene) + "-" + vpApp::fileName(method) + ".csv";
}

std::string sceneName(const std::string &scene) { return "scene/" + vpApp::fileName(scene) + ".json"; }

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
