/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpClearanceSearch.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

vpClearanceSearch::vpClearanceSearch(const vpAvoidanceRunSpec &spec) : m_truth(spec), m_reach(*spec.arm) {}

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
      way += m_reach(i, j) * std::fabs(dq(j));
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

END_VISP_NAMESPACE
