/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectorySpec.h
 * \brief The choices of section 6.2 of the thesis: continuity, replanning policy, synchronisation, timing.
 */
#ifndef vpTrajectoryOptions_h
#define vpTrajectoryOptions_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>

BEGIN_VISP_NAMESPACE

class vpMotionForm;

//! \ingroup group_trajectory
//! \brief Highest derivative that is continuous across replans (6.2, "trajectory type").
enum class vpTrajectoryContinuity {
  C1, //!< Cubic: position and velocity are continuous. The acceleration jumps.
  C2, //!< Quintic: acceleration too; the minimum-jerk motion.
  C3  //!< Septic: jerk too, except where an axis has to brake hard to stay within its limits.
};

//! \ingroup group_trajectory
//! \brief What happens to the arrival time when the goal or the limits change.
enum class vpReplanPolicy {
  EventMinTime, //!< Smallest duration, recomputed at events only: in between it would spoil the final approach.
  KeepArrival,  //!< The arrival time stays unless the limits or the goal's noise delay it; see vpTrajectoryFollower.
  FixedArrival  //!< The arrival time is given: vpTrajectorySpec::arrivalTime.
};

//! \ingroup group_trajectory
//! \brief As tau of every via: the planner chooses when each is passed.
constexpr double vpAutomaticTau = -1.;

//! \ingroup group_trajectory
//! \brief How the axes are synchronised.
enum class vpSynchronisation {
  Time,     //!< All axes arrive at the same time.
  Straight, //!< All axes stay on the straight line to the goal if start and goal velocities lie on it, else Time.
  None      //!< Each axis arrives as early as it can.
};

//! \ingroup group_trajectory
//! \brief How the duration is found.
enum class vpDurationMethod {
  Exact,          //!< vpMinimumDuration, with safe fallback forms when a single polynomial cannot keep the limits.
  ThesisIteration //!< vpThesisDuration, (6.6): a baseline for comparison. May exceed limits; see its documentation.
};

//! \ingroup group_trajectory
//! \brief FixedArrival when the limits do not allow the given time. The result is ArrivalInfeasible in both cases.
enum class vpLateArrival {
  Extend,      //!< Keep the limits and arrive at the earliest feasible time.
  ExceedLimits //!< Keep the time with a single polynomial and exceed the limits (printing; figure 6.5).
};

//! \ingroup group_trajectory
//! \brief Limit on the Euclidean norm over some axes, such as the Cartesian speed of three of them.
struct VISP_EXPORT vpAxisGroup {
  std::uint64_t axes = 0;                                           //!< Bit i set: axis i belongs to the group.
  double maxSpeed = std::numeric_limits<double>::infinity();        //!< unit/s, > 0.
  double maxAcceleration = std::numeric_limits<double>::infinity(); //!< unit/s^2, > 0.

  vpAxisGroup() = default;
  //! Group of these axes, 0 ... 63.
  vpAxisGroup(std::initializer_list<int> members, double speed,
              double acceleration = std::numeric_limits<double>::infinity())
    : maxSpeed(speed), maxAcceleration(acceleration)
  {
    for (int i : members) {
      axes |= i >= 0 && i < 64 ? std::uint64_t(1) << i : 0;
    }
  }
  [[nodiscard]] bool contains(int axis) const { return axis < 64 && (axes >> axis & 1) != 0; } //!< Membership.
};

/*!
 * \ingroup group_trajectory
 * \brief Everything about a trajectory that is not one number per axis.
 *
 * \code
 * vpTrajectoryInput<3> input;
 * input.spec.continuity = vpTrajectoryContinuity::C3;
 * input.spec.policy = vpReplanPolicy::FixedArrival;
 * input.spec.arrivalTime = 2.;                              // s
 * input.spec.groups[0] = vpAxisGroup({0, 1, 2}, 0.25, 0.5); // speed of the tool: m/s, m/s^2
 * \endcode
 */
struct VISP_EXPORT vpTrajectorySpec {
  static constexpr int maxGroups = 4; //!< Largest number of groups.

  vpTrajectoryContinuity continuity = vpTrajectoryContinuity::C2; //!< Continuity across replans.
  vpReplanPolicy policy = vpReplanPolicy::EventMinTime;           //!< Replanning policy.
  vpSynchronisation synchronisation = vpSynchronisation::Time;    //!< Synchronisation of the axes.
  vpDurationMethod method = vpDurationMethod::Exact;              //!< Method that finds the duration.
  vpLateArrival lateArrival = vpLateArrival::Extend;              //!< Infeasible arrival times of FixedArrival.
  /*!
   * Allow ramp, constant velocity, ramp where that saves a fifth of the time of the single polynomial (long moves), or where
   * that has no feasible time. For C2; a group that moves at the start or the goal bends into its constant velocity.
   */
  bool cruise = true;
  const vpMotionForm *form = nullptr; //!< Form of the user's own, tried first: vpMotionForm::find(); null: none.
  double arrivalTime = 0.;            //!< FixedArrival: arrival time, s from the event that set it, > 0.
  double minimumDuration = 0.;        //!< Minimum duration of a plan, s, >= 0; the minimum of KeepArrival.
  double freeze = 0.05; //!< Within this time before arrival a plan is recomputed for a new goal only, s, >= 0.
  //! Rate-based use (6.2.1): period for recomputing the polynomial, s; 0: at events only. A plan through vias stays until an event.
  double replanPeriod = 0.;
  double thesisVelocityGain = 0.5;             //!< d_v of (6.6), s/(unit/s), > 0.
  double thesisAccelerationGain = 0.1;         //!< d_alpha of (6.6), s/(unit/s^2), > 0.
  int thesisStepsPerCycle = 1000;              //!< Iterations per cycle; 1 spreads them over cycles (figure 6.6), >= 1.
  std::array<vpAxisGroup, maxGroups> groups{}; //!< Limits on norms; a group without axes is ignored.
};

//! \ingroup group_trajectory
//! \brief True when both describe the same choices.
[[nodiscard]] VISP_EXPORT bool operator==(const vpTrajectorySpec &a, const vpTrajectorySpec &b);
//! \ingroup group_trajectory
//! \brief True when a choice differs.
[[nodiscard]] inline bool operator!=(const vpTrajectorySpec &a, const vpTrajectorySpec &b) { return !(a == b); }

END_VISP_NAMESPACE
#endif
