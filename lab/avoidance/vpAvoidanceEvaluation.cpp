/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpAvoidanceEvaluation.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

vpClearanceSearch::vpClearanceSearch(const vpAvoidanceRunSpec &spec)
  : m_truth(spec), m_reach(spec.arm->derived<vpReachBounds>())
{}

double vpClearanceSearch::at(double time, const vpJointVector &q)
{
  m_truth.place(time);
  m_truth.scene().place(q, m_data);
  return std::min(m_truth.scene().clearance(m_data, horizon).distance, horizon);
}

// Largest change of any clearance while the joints move by dq within dt. Of two capsules only the outer one moves
// relative to the inner one, by the joints between them.
double vpClearanceSearch::motion(const vpJointVector &dq, double dt) const
{
  double arm = 0.;
  for (int i = 0; i < m_truth.scene().capsuleCount(); ++i) {
    double way = 0.;
    for (int j = 0; j < dq.size(); ++j) {
      way += (*m_reach)(i, j) * std::fabs(dq(j));
    }
    arm = std::max(arm, way);
  }
  return arm + m_truth.fastest() * dt;
}

void vpClearanceSearch::split(Interval &interval, double s0, double c0, double s1, double c1)
{
  *interval.least = std::min({*interval.least, c0, c1});
  interval.touched = interval.touched || c0 <= 0. || c1 <= 0.;
  const double dt = interval.to->time - interval.from->time;
  const vpJointVector dq = interval.to->q - interval.from->q;
  const double moved = motion((s1 - s0) * dq, (s1 - s0) * dt), bound = 0.5 * (c0 + c1 - moved);
  const bool mayTouch = !interval.touched && bound <= 0.;
  if (moved < tolerance || (bound >= *interval.least - tolerance && !mayTouch)) {
    return;
  }
  const double s = 0.5 * (s0 + s1);
  const double c = at(interval.from->time + s * dt, interval.from->q + s * dq);
  split(interval, s0, c0, s, c);
  split(interval, s, c, s1, c1);
}

vpClearanceHistory vpClearanceSearch::search(const std::vector<vpMotionKnot> &knots)
{
  std::vector<double> clearances;
  double standing = horizon, moving = horizon;
  const auto moves = [&](std::size_t i) { // from knot i to the next
    const double dt = knots[i + 1].time - knots[i].time;
    return (knots[i + 1].q - knots[i].q).cwiseAbs().maxCoeff() > movingVelocity * dt;
  };
  for (std::size_t i = 0; i < knots.size(); ++i) {
    m_truth.enter(knots[i].time);
    clearances.push_back(at(knots[i].time, knots[i].q));
    double &least = i + 1 < knots.size() && moves(i) ? moving : standing;
    least = std::min(least, clearances.back());
  }
  vpClearanceHistory history;
  bool touching = false, touchedMoving = false;
  const auto count = [&](bool touched, bool inMotion) {
    if (touching && !touched) {
      ++(touchedMoving ? history.collisionsMoving : history.collisionsStanding);
    }
    touchedMoving = touched && (inMotion || (touching && touchedMoving));
    touching = touched;
  };
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    m_truth.enter(knots[i].time);
    const bool inMotion = moves(i);
    Interval interval{&knots[i], &knots[i + 1], inMotion ? &moving : &standing, false};
    // Obstacles that appear at the end of the interval are excluded from its clearance.
    split(interval, 0., clearances[i], 1., at(knots[i + 1].time, knots[i + 1].q));
    count(interval.touched, inMotion);
  }
  count(false, false);
  history.least = std::min(moving, standing);
  return history;
}

bool vpClearanceSearch::isFreeAhead(double time, const vpJointVector &q, const vpJointVector &velocity, double duration,
                                    double distance)
{
  const vpArmModel &arm = m_truth.scene().arm();
  m_truth.enter(time);
  const double speed = motion(velocity, 1.), least = 1e-3; // s: where the clearance hardly exceeds the distance
  for (double t = 0.; t <= duration;) {
    const vpJointVector there = (q + t * velocity).cwiseMax(arm.lower()).cwiseMin(arm.upper());
    const double clearance = at(time + t, there);
    if (clearance <= distance) {
      return false;
    }
    t += std::max(least, (clearance - distance) / std::max(speed, 1e-9));
  }
  return true;
}

bool vpClearanceSearch::isFreeAlong(double time, const std::vector<vpJointVector> &way, double duration,
                                    double distance)
{
  m_truth.enter(time);
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double share = static_cast<double>(i) / std::max(1., static_cast<double>(way.size()) - 1.);
    if (at(time + share * duration, way[i]) <= distance) {
      return false;
    }
  }
  return true;
}

namespace
{
constexpr double jointTolerance = 1e-6; // relative
constexpr double toolTolerance = 0.01;  // relative: v and a are differences
constexpr double lookAhead = 1.;        // s, for false stops
constexpr int wayPlaces = 100;          // number of samples of the straight paths to the goal
constexpr double falseStopRoom = 0.02;  // m beyond the margin

Eigen::Vector3d toolAt(const vpArmModel &arm, const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::forward(arm, q, data);
  return data.tool.p;
}

// Peaks and bounds of the commanded tool, by differences from rest.
void evaluateTool(const vpAvoidanceRun &run, vpAvoidanceMetrics &m)
{
  const vpAvoidanceMethodSpec &limits = run.spec.methodSpec;
  Eigen::Vector3d p = toolAt(*run.spec.arm, run.samples.front().commanded), v = Eigen::Vector3d::Zero(), a = v;
  for (std::size_t i = 0; i + 1 < run.samples.size(); ++i) {
    const Eigen::Vector3d next = toolAt(*run.spec.arm, run.samples[i + 1].commanded);
    const Eigen::Vector3d velocity = (next - p) / limits.period, acceleration = (velocity - v) / limits.period;
    const double jerk = (acceleration - a).norm() / limits.period;
    m.peak_v = std::max(m.peak_v, velocity.norm());
    m.peak_a = std::max(m.peak_a, acceleration.norm());
    m.peak_jerk = std::max(m.peak_jerk, jerk);
    m.jerk_integral += jerk * jerk * limits.period;
    m.path_length += (run.samples[i + 1].tool - run.samples[i].tool).norm();
    if (!run.samples[i].stopping) {
      m.tool_v_violations += velocity.norm() > limits.maxVelocity * (1. + toolTolerance) ? 1 : 0;
      m.tool_a_violations += acceleration.norm() > limits.maxAcceleration * (1. + toolTolerance) ? 1 : 0;
    }
    p = next;
    v = velocity;
    a = acceleration;
  }
}

void evaluateJoints(const vpAvoidanceRun &run, vpAvoidanceMetrics &m)
{
  const vpArmModel &arm = *run.spec.arm;
  vpJointVector before = vpJointVector::Zero(arm.size());
  for (std::size_t i = 0; i + 1 < run.samples.size(); ++i) {
    const vpJointVector &velocity = run.samples[i].command;
    const vpJointVector change = (velocity - before) / run.spec.methodSpec.period;
    const bool fast = (velocity.array().abs() > arm.velocity().array() * (1. + jointTolerance)).any();
    const bool hard = (change.array().abs() > arm.acceleration().array() * (1. + jointTolerance)).any();
    m.joint_v_violations += fast ? 1 : 0;
    m.joint_a_violations += hard ? 1 : 0;
    before = velocity;
  }
}

bool isStop(const vpAvoidanceSample &s)
{
  return s.stopping || s.status == vpAvoidanceStatus::Waiting || s.status == vpAvoidanceStatus::Unsafe;
}

bool moves(const vpJointVector &velocity)
{
  return velocity.size() > 0 && velocity.cwiseAbs().maxCoeff() > vpClearanceSearch::movingVelocity;
}

//! Straight joint motion to the goal.
std::vector<vpJointVector> jointWay(const vpJointVector &q, const vpAvoidanceGoal &goal)
{
  std::vector<vpJointVector> way;
  for (int i = 0; i < wayPlaces && goal.q.size() == q.size(); ++i) {
    way.push_back(q + static_cast<double>(i) / (wayPlaces - 1) * (goal.q - q));
  }
  return way;
}

//! Straight tool motion to the goal, as far as possible.
std::vector<vpJointVector> toolWay(const vpArmModel &arm, const vpJointVector &q, const vpAvoidanceGoal &goal)
{
  const Eigen::Vector3d from = toolAt(arm, q), line = goal.position - from;
  std::vector<vpJointVector> way = {q};
  for (int i = 1; i < wayPlaces; ++i) {
    vpJointVector next = way.back();
    if (!vpReachPoint(arm, from + static_cast<double>(i) / (wayPlaces - 1) * line, next)) {
      break;
    }
    way.push_back(next);
  }
  return way;
}

double wayTime(const vpAvoidanceRun &run, const std::vector<vpJointVector> &way)
{
  double length = 0.;
  for (std::size_t i = 1; i < way.size(); ++i) {
    length += (toolAt(*run.spec.arm, way[i]) - toolAt(*run.spec.arm, way[i - 1])).norm();
  }
  return length / run.spec.methodSpec.maxVelocity;
}

bool isFalse(const vpAvoidanceRun &run, vpClearanceSearch &search, const vpMovingGoal &goal,
             const vpAvoidanceSample &now, const vpJointVector &velocity)
{
  const double room = run.spec.methodSpec.margin + falseStopRoom;
  const std::vector<vpJointVector> joints = jointWay(now.q, goal.at(now.time));
  const std::vector<vpJointVector> tool = toolWay(*run.spec.arm, now.q, goal.at(now.time));
  return search.isFreeAhead(now.time, now.q, velocity, lookAhead, room) &&
         search.isFreeAlong(now.time, joints, wayTime(run, joints), room) &&
         search.isFreeAlong(now.time, tool, wayTime(run, tool), room);
}

void evaluateStops(const vpAvoidanceRun &run, vpClearanceSearch &search, vpAvoidanceMetrics &m)
{
  const vpMovingGoal goal(run.spec);
  for (std::size_t i = 1; i + 1 < run.samples.size(); ++i) {
    const vpAvoidanceSample &now = run.samples[i], &before = run.samples[i - 1];
    if (isStop(now) && !isStop(before) && moves(before.command)) {
      ++m.stops;
      m.false_stops += isFalse(run, search, goal, now, before.command) ? 1 : 0;
    }
  }
}

// 0 for an empty list.
double percentileMs(const std::vector<double> &seconds, double share)
{
  return seconds.empty() ? 0. : 1000. * vpQuantile(seconds, share);
}

void evaluateEnd(const vpAvoidanceRun &run, vpAvoidanceMetrics &m)
{
  std::size_t first = run.samples.size(); // from which on the arm is at the goal
  while (first > 0 && vpAvoidanceEvaluation::isThere(run.spec, run.samples[first - 1])) {
    --first;
  }
  const bool there = first < run.samples.size();
  m.goal_error_m = run.samples.back().goalDistance;
  m.duration_s = run.samples[there ? first : first - 1].time;
  m.success = there && m.collisions_moving == 0;
  char text[200];
  if (m.collisions_moving > 0) {
    std::snprintf(text, sizeof(text), "touched something while it moved, %d times, by %.1f mm at most",
                  m.collisions_moving, -1000. * std::min(0., m.min_clearance_m));
  }
  else if (there) {
    std::snprintf(text, sizeof(text), "at the goal after %.2f s", m.duration_s);
  }
  else {
    std::snprintf(text, sizeof(text), "%.1f mm from the goal after %.2f s: %s", 1000. * m.goal_error_m, m.duration_s,
                  vpMessage(run.samples.back().status));
  }
  m.status = text;
}
} // namespace

bool vpAvoidanceEvaluation::isAtRest(const vpJointVector &command) { return !moves(command); }

bool vpAvoidanceEvaluation::isThere(const vpAvoidanceRunSpec &spec, const vpAvoidanceSample &sample)
{
  return sample.goalDistance <= spec.goalTolerance && !moves(sample.command);
}

vpAvoidanceMetrics vpAvoidanceEvaluation::evaluate(const vpAvoidanceRun &run, const std::vector<vpMotionKnot> &knots)
{
  vpAvoidanceMetrics m;
  vpClearanceSearch search(run.spec);
  const vpClearanceHistory history = search.search(knots);
  m.min_clearance_m = history.least;
  m.collisions_moving = history.collisionsMoving;
  m.collisions_standing = history.collisionsStanding;
  evaluateTool(run, m);
  evaluateJoints(run, m);
  evaluateStops(run, search, m);
  m.replan_ms_p50 = percentileMs(run.lookTimes, 0.50);
  m.replan_ms_p95 = percentileMs(run.lookTimes, 0.95);
  m.replan_ms_p99 = percentileMs(run.lookTimes, 0.99);
  evaluateEnd(run, m);
  return m;
}

END_VISP_NAMESPACE
