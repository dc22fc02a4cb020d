/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpAvoidanceRunSpec.h"
#include "vpFieldCheck.h"

#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
//! Travelled distance, as a time at full speed, and fraction of the speed; a reversal is centred on phase 0.
struct Shuttle {
  double way = 0.;
  double speed = 1.;
};

Shuttle shuttleAt(double phase, double half, double turn)
{
  const double period = 2. * half;
  phase -= period * std::floor(phase / period);
  const bool back = phase > half;
  const double p = back ? period - phase : phase;
  Shuttle s;
  if (p < 0.5 * turn) {
    s = {p * p / turn, 2. * p / turn};
  }
  else if (p < half - 0.5 * turn) {
    s = {p - 0.25 * turn, 1.};
  }
  else {
    const double left = half - p;
    s = {half - 0.5 * turn - left * left / turn, 2. * left / turn};
  }
  s.speed = back ? -s.speed : s.speed;
  return s;
}
} // namespace

void vpMovingObstacle::validate() const
{
  const std::string name = "obstacle " + object.name;
  const vpFieldCheck fields(name.c_str());
  const double turning = object.velocity.angularNorm();
  fields.require(turning == 0., "angular speed", turning, "0 rad/s");
  fields.positive("turnTime", turnTime, "s");
  fields.require(turnAfter == 0. || (turnAfter > turnTime && std::isfinite(turnAfter)), "turnAfter", turnAfter,
                 "0 or > turnTime, and finite");
  fields.notNegative("appears", appears, "s");
  fields.require(vanishes > appears, "vanishes", vanishes, "later than it appears");
}

void vpMovingObstacle::stateAt(double t, vpRigidTransform &pose, vpTwist &velocity) const noexcept
{
  double way = t, speed = 1.;
  if (turnAfter > 0.) {
    const double start = 0.5 * turnTime; // at full speed
    const Shuttle now = shuttleAt(t + start, turnAfter, turnTime);
    way = now.way - shuttleAt(start, turnAfter, turnTime).way;
    speed = now.speed;
  }
  const Eigen::Vector3d v(object.velocity[0], object.velocity[1], object.velocity[2]);
  pose = object.pose;
  pose.p += way * v;
  velocity = vpTwist(speed * v.x(), speed * v.y(), speed * v.z(), 0., 0., 0.);
}

namespace
{
constexpr vpFieldCheck fields("the avoidance experiment");

void requireFit(const char *field, const vpJointVector &q, int size, bool mayBeEmpty)
{
  if ((mayBeEmpty && q.size() == 0) || (q.size() == size && q.allFinite())) {
    return;
  }
  throw vpException(vpException::badValue, "%s of the avoidance experiment has %d numbers, must have %d finite ones",
                    field, static_cast<int>(q.size()), size);
}

void requirePlace(const char *field, const Eigen::Vector3d &place)
{
  for (const double value : {place.x(), place.y(), place.z()}) {
    fields.finite(field, value);
  }
}

void requireInOrder(const vpAvoidanceRunSpec &spec)
{
  double before = 0.;
  for (const vpGoalMove &move : spec.goalMoves) {
    fields.in("begin of a goal's move", move.begin, vpFieldRange{before}, "s");
    fields.in("end of a goal's move", move.end, vpFieldRange{move.begin}, "s");
    requireFit("the goal", move.to.q, spec.arm->size(), true);
    requirePlace("the goal", move.to.position);
    before = move.end;
  }
  for (const auto &[from, to] : spec.covered) {
    fields.notNegative("begin of a covered interval", from, "s");
    fields.in("end of a covered interval", to, vpFieldRange{from}, "s");
  }
}
} // namespace

void vpAvoidanceRunSpec::validate() const
{
  if (!arm) {
    throw vpException(vpException::badValue, "the avoidance experiment has no arm");
  }
  if (sight == vpObstacleSight::Custom && !makeSensor) {
    throw vpException(vpException::badValue,
                      "makeSensor of the avoidance experiment is empty, a custom sensor needs it");
  }
  methodSpec.validate();
  poses.validate();
  tracks.validate();
  drives.validate(*arm);
  for (const vpMovingObstacle &obstacle : obstacles) {
    obstacle.validate();
  }
  requireFit("the start", start, arm->size(), false);
  requireFit("the goal", goal.q, arm->size(), true);
  requirePlace("the goal", goal.position);
  fields.positive("goalRate", goalRate, "Hz");
  fields.notNegative("goalNoise", goalNoise, "m");
  fields.positive("visionRate", visionRate, "Hz");
  fields.notNegative("latency", latency, "s");
  fields.positive("maxDuration", maxDuration, "s");
  fields.positive("goalTolerance", goalTolerance, "m");
  requireInOrder(*this);
}

END_VISP_NAMESPACE
