/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"

#include "appMain.h"
#include "numberText.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cmath>

namespace avoidObstacle
{
namespace
{
using vpApp::fixed;
using vpApp::number;

constexpr double SHORTEST_TURN = 0.05; // s

void addFrames(const SensorLog &sensorLog, SightingSummary &a)
{
  std::vector<double> errors, sigmas;
  for (const Frame &frame : sensorLog.frames) {
    for (const Sight &sight : frame.sights) {
      if (sight.object != a.object) {
        continue;
      }
      ++a.frames;
      if (!sight.seen) {
        a.lost = a.lastSeen && !a.lost ? frame.time : a.lost;
        continue;
      }
      ++a.seen;
      a.gap = a.lastSeen ? std::max(a.gap, frame.time - *a.lastSeen) : 0.;
      a.firstSeen = a.firstSeen.value_or(frame.time);
      a.lastSeen = frame.time;
      a.lost.reset();
      errors.push_back(sight.error);
      sigmas.push_back(sight.sigma);
      a.worstError = std::max(a.worstError, sight.error);
    }
  }
  a.medianError = vpMedian(errors);
  a.medianSigma = vpMedian(sigmas);
}

void addTracks(const SensorLog &sensorLog, SightingSummary &a)
{
  for (const TrackRow &row : sensorLog.tracks) {
    if (row.track.name != a.object) {
      continue;
    }
    const double margin = row.track.inflation - row.error;
    a.leastMargin = a.known ? std::min(a.leastMargin, margin) : margin;
    a.known = a.known.value_or(row.time);
    a.worstTrackError = std::max(a.worstTrackError, row.error);
  }
}

std::string ms(double seconds) { return number(1000. * seconds, 3) + " ms"; }
std::string mm(double metres) { return fixed(1000. * metres, 1) + " mm"; }

std::string ending(const vpAvoidanceRun &run)
{
  const vpAvoidanceMetrics &m = run.metrics;
  if (m.success) {
    return "The tool arrived after " + fixed(m.duration_s, 2) + " s, " + mm(m.goal_error_m) +
           " from the goal, and touched nothing on the way.";
  }
  if (m.collisions_moving > 0) {
    return "The arm " + m.status + ". In the end the tool was " + mm(m.goal_error_m) + " from the goal.";
  }
  return "The tool did not arrive: after " + fixed(run.samples.back().time, 2) + " s it was " + mm(m.goal_error_m) +
         " from the goal, and touched nothing. The run ended as " + run.ended + ". " + run.message;
}

std::string seeing(const SightingSummary &a, const vpAvoidanceRun &run)
{
  if (!a.firstSeen) {
    return "Obstacle " + a.object + " was never seen, so the method never knew of it.";
  }
  std::string text = "Obstacle " + a.object + " was first seen in the picture of " + fixed(*a.firstSeen, 3) +
                     " s and " +
                     (a.known ? "known to the method at " + fixed(*a.known, 3) + " s" : "never known to the method") +
                     "; it was seen in " + std::to_string(a.seen) + " of " + std::to_string(a.frames) +
                     " pictures, with errors of " + mm(a.medianError) + " (median) and " + mm(a.worstError) +
                     " (worst) where the sightings reported deviations of " + mm(a.medianSigma) + ".";
  if (a.lost) {
    text += " From " + fixed(*a.lost, 3) + " s on it was not seen any more";
    text += run.samples.back().time > *a.lost ? ", and kept in mind by the track table alone." : ".";
  }
  if (a.gap > 2.5 / run.spec.visionRate) {
    text += " The longest gap in between was " + fixed(a.gap, 2) + " s.";
  }
  text += a.leastMargin >= 0. ? " Its true place never left the uncertainty that the track table reported."
                              : " Its true place was up to " + mm(-a.leastMargin) +
                                    " outside the uncertainty that the track table reported.";
  return text;
}
} // namespace

std::vector<SightingSummary> sightingSummaries(const PhotoScene &scene, const Episode &episode)
{
  std::vector<SightingSummary> all;
  for (const vpMovingObstacle &obstacle : scene.obstacles) {
    SightingSummary a;
    a.object = obstacle.object.name;
    addFrames(episode.sensorLog, a);
    addTracks(episode.sensorLog, a);
    all.push_back(a);
  }
  return all;
}

std::vector<StatusChange> statusChangesOf(const vpAvoidanceRun &run)
{
  std::vector<StatusChange> turns;
  for (const vpAvoidanceSample &s : run.samples) {
    if (turns.empty() || turns.back().status != s.status || turns.back().stopping != s.stopping) {
      if (turns.size() > 1 && s.time - turns.back().time < SHORTEST_TURN) {
        turns.pop_back();
      }
      if (turns.empty() || turns.back().status != s.status || turns.back().stopping != s.stopping) {
        turns.push_back({s.time, s.status, s.stopping});
      }
    }
  }
  return turns;
}

JointUse jointUseOf(const vpAvoidanceRun &run)
{
  JointUse use;
  const vpArmModel &arm = *run.spec.arm;
  vpJointVector before = vpJointVector::Zero(arm.size());
  for (const vpAvoidanceSample &s : run.samples) {
    for (int i = 0; i < arm.size(); ++i) {
      const vpArmJointSpec &joint = arm.spec().joints[static_cast<std::size_t>(i)];
      use.velocity = std::max(use.velocity, std::fabs(s.command(i)) / joint.velocity);
      const double a = std::fabs(s.command(i) - before(i)) / run.spec.methodSpec.period;
      use.acceleration = std::max(use.acceleration, a / joint.acceleration);
    }
    before = s.command;
  }
  return use;
}

std::vector<std::string> findingsOf(const PhotoScene &scene, const Options &options, const Episode &episode)
{
  const vpAvoidanceRun &run = episode.run;
  const vpAvoidanceMetrics &m = run.metrics;
  std::vector<std::string> findings = {ending(run)};
  findings.push_back("The least true clearance of the whole arm was " + mm(m.min_clearance_m) + " (the method keeps " +
                     mm(run.spec.methodSpec.margin) + " from what it knows); the arm was stopped " +
                     std::to_string(m.stops) + " times for safety.");
  for (const SightingSummary &a : sightingSummaries(scene, episode)) {
    if (options.sensor == SensorKind::Depth) {
      continue;
    }
    findings.push_back(seeing(a, run));
  }
  if (options.sensor == SensorKind::Depth) {
    findings.push_back("Depth images know no single objects: all that they show is one map of cubes, at rest.");
  }
  findings.push_back("The commanded tool went at up to " + number(m.peak_v, 3) + " m/s (bound " +
                     number(run.spec.methodSpec.maxVelocity, 3) + ") and " + number(m.peak_a, 3) + " m/s^2 (bound " +
                     number(run.spec.methodSpec.maxAcceleration, 3) + "); a look at a new picture took the method " +
                     ms(1e-3 * m.replan_ms_p50) + " (median) and " + ms(1e-3 * m.replan_ms_p99) + " (99 %).");
  findings.insert(findings.end(), scene.remarks.begin(), scene.remarks.end());
  return findings;
}

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
          {"ideal_drives", run.spec.drives.ideal},
          {"seed", options.seed},
          {"max_duration_s", options.duration},
          {"period_s", run.spec.methodSpec.period},
          {"max_velocity_mps", run.spec.methodSpec.maxVelocity},
          {"max_acceleration_mps2", run.spec.methodSpec.maxAcceleration},
          {"margin_m", run.spec.methodSpec.margin},
          {"goal_tolerance_m", run.spec.goalTolerance}};
}
} // namespace

Json summaryOf(const PhotoScene &scene, const Options &options, const Episode &episode, const std::string &commandLine)
{
  Json obstacles = Json::array(), turns = Json::array();
  for (const SightingSummary &a : sightingSummaries(scene, episode)) {
    obstacles.push_back(jsonOf(a));
  }
  for (const StatusChange &turn : statusChangesOf(episode.run)) {
    turns.push_back({{"time_s", turn.time},
                     {"status", vpToString(turn.status)},
                     {"means", vpMessage(turn.status)},
                     {"stopping", turn.stopping}});
  }
  const JointUse use = jointUseOf(episode.run);
  return {{"program", "visp-avoid-obstacle"},
          {"version", vpApp::versionText()},
          {"command_line", commandLine},
          {"data", "simulated arm and camera; the obstacles' photographs are real, their views are rendered"},
          {"arm", scene.arm->label()},
          {"scene", scene.name},
          {"scene_file", scene.known.source},
          {"task", scene.task.name},
          {"settings", settings(options, episode.run)},
          {"metrics", vpApp::metricsJson(episode.run.metrics)},
          {"ended_as", vpToString(episode.run.samples.back().status)},
          {"joint_velocity_share", use.velocity},
          {"joint_acceleration_share", use.acceleration},
          {"obstacles", obstacles},
          {"turns", turns},
          {"findings", findingsOf(scene, options, episode)},
          {"remarks", scene.remarks},
          {"warnings", scene.warnings}};
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
          {"findings", replica.findings},
          {"choices", replica.choices},
          {"numbers", replica.numbers}};
}

std::string tracksCsv(const SensorLog &sensorLog)
{
  std::string csv = "time_s,object,status,resting,x_m,y_m,z_m,velocity_x_mps,velocity_y_mps,velocity_z_mps,"
                    "position_sigma_m,velocity_sigma_mps,inflation_m,confidence,age_s,sightings,restarts,error_m\n";
  for (const TrackRow &r : sensorLog.tracks) {
    const vpObjectTrack &t = r.track;
    vpApp::CsvRow row;
    row << r.time << t.name << vpToString(t.status) << t.resting << t.pose.p
        << Eigen::Vector3d(t.velocity[0], t.velocity[1], t.velocity[2]) << t.positionSigma << t.velocitySigma
        << t.inflation << t.confidence << t.age << t.sightings << t.restarts << r.error;
    csv += row.line();
  }
  return csv;
}

std::string framesCsv(const SensorLog &sensorLog)
{
  std::string csv = "time_s,covered,object,seen,error_m,angle_error_rad,sigma_m,sentence\n";
  for (const Frame &frame : sensorLog.frames) {
    for (const Sight &s : frame.sights) {
      vpApp::CsvRow row;
      row << frame.time << frame.covered << s.object << s.seen << (s.seen ? s.error : NAN)
          << (s.seen ? s.angleError : NAN) << (s.seen ? s.sigma : NAN) << s.message;
      csv += row.line();
    }
  }
  return csv;
}
} // namespace avoidObstacle
