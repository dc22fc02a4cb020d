/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpTrajectoryResult.h>

#include <cstdio>
#include <cstring>

BEGIN_VISP_NAMESPACE

namespace
{
// Sentence of a fault; %d is the index, %g the value, in this order.
const char *sentence(vpTrajectoryFault fault)
{
  switch (fault) {
  case vpTrajectoryFault::None:
    return "";
  case vpTrajectoryFault::StartNotFinite:
    return "start state of axis %d has the value %g, must be finite";
  case vpTrajectoryFault::GoalNotFinite:
    return "goal state of axis %d has the value %g, must be finite";
  case vpTrajectoryFault::OutOfRange:
    return "axis %d has the value %g, numbers must be at most 1e12 and limits at least 1e-12";
  case vpTrajectoryFault::VelocityLimit:
    return "velocity limit of axis %d is %g, must be > 0";
  case vpTrajectoryFault::AccelerationLimit:
    return "acceleration limit of axis %d is %g, must be > 0";
  case vpTrajectoryFault::JerkLimit:
    return "jerk limit of axis %d is %g, must be > 0";
  case vpTrajectoryFault::NoLimit:
    return "axis %d has neither a velocity nor an acceleration limit (both are %g), one must be finite";
  case vpTrajectoryFault::PositionLimits:
    return "position limits of axis %d are in the wrong order, the upper one is %g";
  case vpTrajectoryFault::GoalOutsidePosition:
    return "goal position of axis %d is %g, outside its position limits";
  case vpTrajectoryFault::GoalOutsideVelocity:
    return "goal velocity of axis %d is %g, above its velocity limit";
  case vpTrajectoryFault::GoalOutsideAcceleration:
    return "goal acceleration of axis %d is %g, above its acceleration limit";
  case vpTrajectoryFault::GoalOutsideGroup:
    return "goal velocity or acceleration of axis group %d has the norm %g, above the limit of the group";
  case vpTrajectoryFault::GroupLimit:
    return "limit of axis group %d is %g, must be > 0";
  case vpTrajectoryFault::GroupAxis:
    return "axis group %d names axis %g, which does not exist or is in another group already";
  case vpTrajectoryFault::ViaNotFinite:
    return "via %d has the value %g, must be finite";
  case vpTrajectoryFault::ViaTime:
    return "tau of via %d is %g, must be in (0, 1)";
  case vpTrajectoryFault::ViaOrder:
    return "tau of via %d is %g, must be above that of the via before";
  case vpTrajectoryFault::ViaOutsideLimits:
    return "via %d has the value %g, outside the limits of its axis";
  case vpTrajectoryFault::TooManyVias:
    return "room was made for %d vias, got %g";
  case vpTrajectoryFault::ViaContinuity:
    return "vias need continuity C2; there are vias (up to via %d) with continuity C%g";
  case vpTrajectoryFault::AxisCount:
    return "a vector must have %d numbers, one per axis, got %g";
  case vpTrajectoryFault::ArrivalTime:
    return "arrival time is %g s, must be > 0 and finite";
  case vpTrajectoryFault::Duration:
    return "minimum duration, freeze time or replan period is %g s, must be >= 0 and finite";
  case vpTrajectoryFault::ThesisGain:
    return "gain of the thesis's iteration is %g, must be > 0 and finite";
  case vpTrajectoryFault::ThesisSteps:
    return "steps per cycle of the thesis's iteration are %g, must be >= 1";
  case vpTrajectoryFault::NotARotation:
    return "the rotation of the pose differs from an orthonormal one by %g";
  case vpTrajectoryFault::TimeStep:
    return "dt is %g s, must be > 0 and finite, at most 1e6 s";
  case vpTrajectoryFault::GoalContradiction:
    return "the goal acceleration of axis %d (%g) cannot be reached within its velocity and jerk limits; it was "
           "dropped";
  case vpTrajectoryFault::PositionUnreachable:
    return "axis %d at %g moves too fast to stay within its position limits; they are not kept";
  case vpTrajectoryFault::ArrivalTooEarly:
    return "the arrival time cannot be kept within the limits; the earliest feasible arrival is in %g s";
  }
  return "";
}

const char *sentence(vpTrajectoryResult result)
{
  switch (result) {
  case vpTrajectoryResult::Working:
    return "on the way, within the limits";
  case vpTrajectoryResult::Finished:
    return "the goal was reached in this cycle";
  case vpTrajectoryResult::Holding:
    return "the goal was reached before, nothing changed";
  case vpTrajectoryResult::Braking:
    return "the start is outside the limits, coming back inside";
  case vpTrajectoryResult::InvalidInput:
    return "the input is invalid";
  case vpTrajectoryResult::NoFeasibleDuration:
    return "the limits contradict each other";
  case vpTrajectoryResult::ArrivalInfeasible:
    return "the arrival time cannot be kept within the limits";
  }
  return "";
}
} // namespace

std::string vpTrajectoryStatus::message() const
{
  if (fault == vpTrajectoryFault::None) {
    return sentence(result);
  }
  char text[200];
  const char *form = sentence(fault);
  if (std::strstr(form, "%d") != nullptr) {
    std::snprintf(text, sizeof(text), form, index, value);
  }
  else {
    std::snprintf(text, sizeof(text), form, value);
  }
  return text;
}

const char *toString(vpTrajectoryResult result)
{
  switch (result) {
  case vpTrajectoryResult::Working:
    return "Working";
  case vpTrajectoryResult::Finished:
    return "Finished";
  case vpTrajectoryResult::Holding:
    return "Holding";
  case vpTrajectoryResult::Braking:
    return "Braking";
  case vpTrajectoryResult::InvalidInput:
    return "InvalidInput";
  case vpTrajectoryResult::NoFeasibleDuration:
    return "NoFeasibleDuration";
  case vpTrajectoryResult::ArrivalInfeasible:
    return "ArrivalInfeasible";
  }
  return "";
}

END_VISP_NAMESPACE
