/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "summary.h"
#include "appMain.h"

#include "options.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>

namespace planCompare
{
namespace
{
using Json = nlohmann::ordered_json;

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

Json summaryOf(const Plan &plan, const Results &results, const Extras &extras)
{
  Json cells = Json::array(), variants = Json::array(), pairs = Json::array();
  for (const SceneInfo &scene : plan.scenes) {
    const std::vector<std::string> parts = results.variants(scene.id);
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
                          {"validator", row.validator},
                          {"plans", row.plans},
                          {"solved", row.solved},
                          {"planning_ms_p50", row.p50},
                          {"planning_ms_p95", row.p95},
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
          {"methods", plan.methods},
          {"results", cells},
          {"variants", variants},
          {"pairs", pairs},
          {"self_motion", selfMotion},
          {"validators", validators}};
}
} // namespace planCompare
