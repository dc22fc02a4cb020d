/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "findings.h"

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
         " from the goal, and touched nothing. " + run.message;
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
} // namespace avoidObstacle
