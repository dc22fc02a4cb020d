/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryResult.h
 * \brief How a trajectory step went, as a value and as a sentence.
 */
#ifndef vpTrajectoryResult_h
#define vpTrajectoryResult_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_trajectory
//! \brief Result of a step. The motion is safe to execute in every case, unless an option explicitly allows excess.
enum class vpTrajectoryResult {
  Working,            //!< On the way, within the limits.
  Finished,           //!< The goal was reached in this cycle.
  Holding,            //!< The goal was reached earlier; nothing changed.
  Braking,            //!< The start was outside the limits: returning inside as fast as the limits allow.
  InvalidInput,       //!< The input has an invalid value; the motion continues as planned before.
  NoFeasibleDuration, //!< Not all limits can be kept: the motion keeps the others and exceeds these minimally.
  ArrivalInfeasible   //!< The given arrival time is not feasible within the limits.
};

/*!
 * \ingroup group_trajectory
 * \brief Loop condition: true while the motion goes to its goal within the limits (Working, Braking).
 *
 * False ends the loop: at the goal (Finished, Holding), or at an error that more cycles with the same input cannot fix
 * (InvalidInput, NoFeasibleDuration, ArrivalInfeasible); vpTrajectoryStatus::message() names it. An error does not stop
 * the motion: further cycles follow the current plan, so a program may also correct the input, or brake, and go on.
 */
[[nodiscard]] constexpr bool vpIsWorking(vpTrajectoryResult result)
{
  return result == vpTrajectoryResult::Working || result == vpTrajectoryResult::Braking;
}

//! \ingroup group_trajectory
//! \brief Detailed reason of a result.
enum class vpTrajectoryFault {
  None,                    //!< Nothing.
  StartNotFinite,          //!< A number of the start state is NaN or infinite.
  GoalNotFinite,           //!< A number of the goal state is NaN or infinite.
  OutOfRange,              //!< A number is above 1e12 or a limit below 1e-12: beyond what can be computed reliably.
  VelocityLimit,           //!< A velocity limit is not > 0.
  AccelerationLimit,       //!< An acceleration limit is not > 0.
  JerkLimit,               //!< A jerk limit is not > 0.
  NoLimit,                 //!< Neither velocity nor acceleration is limited.
  PositionLimits,          //!< The lower position limit is not below the upper one.
  GoalOutsidePosition,     //!< The goal is outside its position limits.
  GoalOutsideVelocity,     //!< The goal velocity is above its limit.
  GoalOutsideAcceleration, //!< The goal acceleration is above its limit.
  GoalOutsideJerk,         //!< The goal jerk is above its limit (continuity C3).
  GoalOutsideGroup,        //!< The goal velocity of a group is above its limit.
  GroupLimit,              //!< A limit of a group is not > 0, or beyond 1e-12 to 1e12.
  GroupAxis,               //!< A group names an axis that does not exist, or an axis of another group.
  ViaNotFinite,            //!< A number of a via is NaN or infinite.
  ViaTime,                 //!< tau of a via is not in (0, 1), or automatic in some vias only.
  ViaOrder,                //!< tau of a via is not above the tau of the previous via.
  ViaOutsideLimits,        //!< Position, velocity or acceleration of a via is outside the limits.
  TooManyVias,             //!< More vias than the maximum.
  ViaContinuity,           //!< Vias need continuity C2.
  AxisCount,               //!< A vector does not have one number per axis.
  ArrivalTime,             //!< The arrival time of FixedArrival is not within 1e-9 to 1e12 s.
  Duration,                //!< minimumDuration, freeze or replanPeriod is not within 0 to 1e12 s.
  ThesisGain,              //!< A gain of (6.6) is not within 1e-12 to 1e12.
  ThesisSteps,             //!< The number of steps per cycle is not >= 1.
  NotARotation,            //!< The rotation of a pose is not orthonormal to 1e-6.
  TimeStep,                //!< dt is not > 0 and at most 1e9 s.
  GoalContradiction,       //!< The goal cannot be approached within the limits (such as v = v_max with a < 0).
  LimitExceeded,           //!< A limit cannot be kept; vpTrajectoryStatus::excess gives the limit and the excess.
  StartOutsideLimits,      //!< The start is outside a limit; vpTrajectoryStatus::excess gives the maximum.
  NotStraight,             //!< The axes arrive together, but not on the straight line requested.
  NoMotion,                //!< No motion could be computed; the axes come to rest.
  ArrivalTooEarly          //!< The given arrival time is too early for the limits.
};

//! \ingroup group_trajectory
//! \brief Kind of limit.
enum class vpTrajectoryLimit {
  None,             //!< None is exceeded.
  MinPosition,      //!< Lowest position of an axis.
  MaxPosition,      //!< Highest position of an axis.
  Velocity,         //!< Velocity of an axis.
  Acceleration,     //!< Acceleration of an axis.
  Jerk,             //!< Jerk of an axis.
  GroupSpeed,       //!< Norm of the velocities of a group.
  GroupAcceleration //!< Norm of the accelerations of a group.
};

/*!
 * \ingroup group_trajectory
 * \brief A limit and the excess of a motion over it, at its exact extremum.
 */
struct VISP_EXPORT vpLimitExcess {
  vpTrajectoryLimit limit = vpTrajectoryLimit::None; //!< Kind of limit.
  int index = -1;                                    //!< Axis or group, from 0.
  double value = 0.;                                 //!< Largest value; the lowest position for MinPosition.
  double bound = 0.;                                 //!< Allowed value.

  //! Excess, >= 0, in the unit of the limit.
  [[nodiscard]] double amount() const
  {
    return limit == vpTrajectoryLimit::MinPosition ? bound - value : value - bound;
  }
};

/*!
 * \ingroup group_trajectory
 * \brief Result with its reason: the axis and the value concerned.
 */
struct VISP_EXPORT vpTrajectoryStatus {
  vpTrajectoryResult result = vpTrajectoryResult::Holding; //!< Result of the step.
  vpTrajectoryFault fault = vpTrajectoryFault::None;       //!< Reason, when something is wrong.
  int index = -1;                                          //!< Axis (from 0), via or group concerned; -1: none.
  double value = 0.;    //!< The invalid value, or the earliest feasible arrival in s.
  vpLimitExcess excess; //!< The limit exceeded most, relative to it; None: all are kept, to 1e-9.

  //! Holding, without a fault.
  constexpr vpTrajectoryStatus() = default;
  //! Status from its parts.
  constexpr vpTrajectoryStatus(vpTrajectoryResult theResult, vpTrajectoryFault theFault, int theIndex, double theValue,
                               const vpLimitExcess &theExcess = {})
    : result(theResult), fault(theFault), index(theIndex), value(theValue), excess(theExcess)
  {}

  //! True unless the input is invalid or limits cannot be kept.
  [[nodiscard]] bool isGood() const
  {
    return result != vpTrajectoryResult::InvalidInput && result != vpTrajectoryResult::NoFeasibleDuration &&
           result != vpTrajectoryResult::ArrivalInfeasible;
  }
  //! One sentence that names axis and value, such as "velocity limit of axis 3 is -1, must be > 0". Allocates.
  [[nodiscard]] std::string message() const;
};

//! \ingroup group_trajectory
//! \brief The result as a word ("Working"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpTrajectoryResult result);
//! \ingroup group_trajectory
//! \brief The limit as words ("velocity"), for messages; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpTrajectoryLimit limit);

END_VISP_NAMESPACE
#endif
