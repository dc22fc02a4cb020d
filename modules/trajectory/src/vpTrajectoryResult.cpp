/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpTrajectoryResult.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

BEGIN_VISP_NAMESPACE

namespace
{
// Sentence of a fault; %d is the index, %s the value, in this order.
const char *sentenceOf(vpTrajectoryFault fault)
{
  switch (fault) {
  case vpTrajectoryFault::None:
    return "";
  case vpTrajectoryFault::StartNotFinite:
    return "start state of axis %d has the value %s, must be finite";
  case vpTrajectoryFault::GoalNotFinite:
    return "goal state of axis %d has the value %s, must be finite";
  case vpTrajectoryFault::OutOfRange:
    return "axis %d has the value %s, numbers must be at most 1e12 and limits at least 1e-12";
  case vpTrajectoryFault::VelocityLimit:
    return "velocity limit of axis %d is %s, must be > 0";
  case vpTrajectoryFault::AccelerationLimit:
    return "acceleration limit of axis %d is %s, must be > 0";
  case vpTrajectoryFault::JerkLimit:
    return "jerk limit of axis %d is %s, must be > 0";
  case vpTrajectoryFault::NoLimit:
    return "axis %d has neither a velocity nor an acceleration limit (both are %s), one must be finite";
  case vpTrajectoryFault::PositionLimits:
    return "position limits of axis %d are in the wrong order, the upper one is %s";
  case vpTrajectoryFault::GoalOutsidePosition:
    return "goal position of axis %d is %s, outside its position limits";
  case vpTrajectoryFault::GoalOutsideVelocity:
    return "goal velocity of axis %d is %s, above its velocity limit";
  case vpTrajectoryFault::GoalOutsideAcceleration:
    return "goal acceleration of axis %d is %s, above its acceleration limit";
  case vpTrajectoryFault::GoalOutsideJerk:
    return "goal jerk of axis %d is %s, above its jerk limit";
  case vpTrajectoryFault::GoalOutsideGroup:
    return "goal velocity or acceleration of axis group %d has the norm %s, above the limit of the group";
  case vpTrajectoryFault::GroupLimit:
    return "limit of axis group %d is %s, must be > 0: from 1e-12 to 1e12, or infinite";
  case vpTrajectoryFault::GroupAxis:
    return "axis group %d names axis %s, which does not exist or is in another group already";
  case vpTrajectoryFault::ViaNotFinite:
    return "via %d has the value %s, must be finite";
  case vpTrajectoryFault::ViaTime:
    return "tau of via %d is %s, must be in (0, 1), or automatic in all vias";
  case vpTrajectoryFault::ViaOrder:
    return "tau of via %d is %s, must be above that of the via before";
  case vpTrajectoryFault::ViaOutsideLimits:
    return "via %d has the value %s, outside the limits of its axis";
  case vpTrajectoryFault::TooManyVias:
    return "room was made for %d vias, got %s";
  case vpTrajectoryFault::ViaContinuity:
    return "vias need continuity C2; there are vias (up to via %d) with continuity C%s";
  case vpTrajectoryFault::AxisCount:
    return "a vector must have %d numbers, one per axis, got %s";
  case vpTrajectoryFault::ArrivalTime:
    return "arrival time is %s s, must be > 0: from 1e-9 to 1e12";
  case vpTrajectoryFault::Duration:
    return "minimum duration, freeze time or replan period is %s s, must be >= 0 and at most 1e12";
  case vpTrajectoryFault::ThesisGain:
    return "gain of the thesis's iteration is %s, must be > 0: from 1e-12 to 1e12";
  case vpTrajectoryFault::ThesisSteps:
    return "steps per cycle of the thesis's iteration are %s, must be >= 1";
  case vpTrajectoryFault::NotARotation:
    return "the rotation of the pose differs from an orthonormal one by %s";
  case vpTrajectoryFault::TimeStep:
    return "dt is %s s, must be > 0 and finite: at most 1e9";
  case vpTrajectoryFault::GoalContradiction:
    return "the goal acceleration of axis %d (%s) cannot be reached within its velocity and jerk limits; it was "
           "dropped";
  case vpTrajectoryFault::LimitExceeded:
    return "not all limits can be kept";
  case vpTrajectoryFault::StartOutsideLimits:
    return "the start is outside the limits, coming back inside";
  case vpTrajectoryFault::NotStraight:
    return "the axes arrive together, but not on the straight line: start or goal of axis %d has a derivative of %s "
           "across it";
  case vpTrajectoryFault::NoMotion:
    return "no motion to the goal could be computed; the axes come to rest";
  case vpTrajectoryFault::ArrivalTooEarly:
    return "the arrival time cannot be kept within the limits; the earliest feasible arrival is in %s s";
  }
  return "";
}

// The fewest digits that identify this number.
struct Digits {
  char text[32];
  explicit Digits(double value)
  {
    for (int digits = 6; digits <= 17; ++digits) {
      std::snprintf(text, sizeof(text), "%.*g", digits, value);
      if (std::strtod(text, nullptr) == value) {
        break;
      }
    }
  }
};

bool isOfGroup(vpTrajectoryLimit limit)
{
  return limit == vpTrajectoryLimit::GroupSpeed || limit == vpTrajectoryLimit::GroupAcceleration;
}

const char *sentenceOf(vpTrajectoryResult result)
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
    return "not all limits can be kept";
  case vpTrajectoryResult::ArrivalInfeasible:
    return "the arrival time cannot be kept within the limits";
  }
  return "";
}
} // namespace

std::string vpTrajectoryStatus::message() const
{
  std::string text = sentenceOf(result);
  if (fault != vpTrajectoryFault::None) {
    char buffer[256];
    const char *form = sentenceOf(fault);
    const Digits digits(value);
    if (std::strstr(form, "%d") != nullptr) {
      std::snprintf(buffer, sizeof(buffer), form, index, digits.text);
    }
    else {
      std::snprintf(buffer, sizeof(buffer), form, digits.text);
    }
    text = buffer;
  }
  if (excess.limit != vpTrajectoryLimit::None) {
    char amount[32];
    std::snprintf(amount, sizeof(amount), "%.3g", excess.amount());
    text += std::string(": the ") + vpToString(excess.limit) + " of " + (isOfGroup(excess.limit) ? "group " : "axis ") +
            std::to_string(excess.index) + " is " + Digits(excess.value).text + ", its limit " +
            Digits(excess.bound).text + ", exceeded by " + amount;
  }
  return text;
}

const char *vpToString(vpTrajectoryResult result)
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

const char *vpToString(vpTrajectoryLimit limit)
{
  switch (limit) {
  case vpTrajectoryLimit::None:
    return "nothing";
  case vpTrajectoryLimit::MinPosition:
    return "lowest position";
  case vpTrajectoryLimit::MaxPosition:
    return "highest position";
  case vpTrajectoryLimit::Velocity:
    return "velocity";
  case vpTrajectoryLimit::Acceleration:
    return "acceleration";
  case vpTrajectoryLimit::Jerk:
    return "jerk";
  case vpTrajectoryLimit::GroupSpeed:
    return "speed";
  case vpTrajectoryLimit::GroupAcceleration:
    return "norm of the accelerations";
  }
  return "";
}

END_VISP_NAMESPACE
