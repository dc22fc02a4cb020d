/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "summary.h"
#include "appMain.h"

namespace avoidObstacle
{
namespace
{
using Json = nlohmann::ordered_json;

Json optional(const std::optional<double> &value) { return value ? Json(*value) : Json(nullptr); }

Json jsonOf(const SightingSummary &a)
{
  return {{"object", a.object},
          {"pictures", a.frames},
          {"seen", a.seen},
          {"first_seen_s", optional(a.firstSeen)},
          {"known_s", optional(a.known)},
          {"last_seen_s", optional(a.lastSeen)},
          {"lost_s", optional(a.lost)},
          {"longest_gap_s", a.gap},
          {"median_error_m", a.medianError},
          {"worst_error_m", a.worstError},
          {"median_sigma_m", a.medianSigma},
          {"worst_track_error_m", a.worstTrackError},
          {"least_inflation_less_error_m", a.leastMargin}};
}

Json settings(const Options &options, const vpAvoidanceRun &run)
{
  Json hidden = Json::array();
  for (const auto &[from, until] : options.hidden) {
    hidden.push_back({from, until});
  }
  return {{"method", options.method},
          {"sensor", nameOf(options.sensor)},
          {"hidden_s", hidden},
          {"vision_rate_hz", options.visionRate},
          {"latency_s", options.latency},
          {"noise_grey", options.noise},
          {"forget_s", options.forget},
          {"friction", options.friction},
          {"seed", options.seed},
          {"max_duration_s", options.duration},
          {"period_s", run.spec.methodSpec.period},
          {"max_velocity_mps", run.spec.methodSpec.maxVelocity},
          {"max_acceleration_mps2", run.spec.methodSpec.maxAcceleration},
          {"margin_m", run.spec.methodSpec.margin},
          {"goal_tolerance_m", run.spec.goalTolerance}};
}
} // namespace

Json metricsJson(const vpAvoidanceMetrics &m)
{
  return {{"success", m.success},
          {"min_clearance_m", m.min_clearance_m},
          {"goal_error_m", m.goal_error_m},
          {"duration_s", m.duration_s},
          {"peak_v", m.peak_v},
          {"peak_a", m.peak_a},
          {"peak_jerk", m.peak_jerk},
          {"jerk_integral", m.jerk_integral},
          {"path_length", m.path_length},
          {"replan_ms_p50", m.replan_ms_p50},
          {"replan_ms_p95", m.replan_ms_p95},
          {"replan_ms_p99", m.replan_ms_p99},
          {"stops", m.stops},
          {"false_stops", m.false_stops},
          {"collisions_moving", m.collisions_moving},
          {"collisions_standing", m.collisions_standing},
          {"joint_v_violations", m.joint_v_violations},
          {"joint_a_violations", m.joint_a_violations},
          {"tool_v_violations", m.tool_v_violations},
          {"tool_a_violations", m.tool_a_violations},
          {"status", m.status}};
}

Json summaryOf(const PhotoScene &scene, const Options &options, const Episode &episode, const std::string &commandLine,
               double wallTime)
{
  Json obstacles = Json::array(), turns = Json::array();
  for (const SightingSummary &a : sightingSummaries(scene, episode)) {
    obstacles.push_back(jsonOf(a));
  }
  for (const StatusChange &turn : statusChangesOf(episode.run)) {
    turns.push_back({{"time_s", turn.time}, {"status", vpToString(turn.status)}, {"stopping", turn.stopping}});
  }
  const JointUse use = jointUseOf(episode.run);
  return {{"program", "visp-avoid-obstacle"},
          {"version", vpApp::versionText()},
          {"command_line", commandLine},
          {"wall_time_s", wallTime},
          {"data", "simulated arm and camera; the obstacles' photographs are real, their views are rendered"},
          {"arm", scene.arm->label()},
          {"scene", scene.name},
          {"scene_file", scene.known.source},
          {"task", scene.task.name},
          {"settings", settings(options, episode.run)},
          {"metrics", metricsJson(episode.run.metrics)},
          {"ended_as", vpToString(episode.run.samples.back().status)},
          {"joint_velocity_share", use.velocity},
          {"joint_acceleration_share", use.acceleration},
          {"obstacles", obstacles},
          {"turns", turns},
          {"remarks", scene.remarks}};
}

Json summaryOf(const Replica &replica, const Options &options, const std::string &commandLine, double wallTime)
{
  Json comparisons = Json::array();
  for (const Comparison &c : replica.comparisons) {
    comparisons.push_back({{"what", c.what}, {"thesis", c.thesis}, {"here", c.ours}, {"agrees", c.agrees}});
  }
  return {{"program", "visp-avoid-obstacle"},
          {"version", vpApp::versionText()},
          {"command_line", commandLine},
          {"wall_time_s", wallTime},
          {"data", "simulated"},
          {"replica", replica.name},
          {"title", replica.title},
          {"seed", options.seed},
          {"comparisons", comparisons},
          {"choices", replica.choices},
          {"numbers", replica.numbers}};
}
} // namespace avoidObstacle
