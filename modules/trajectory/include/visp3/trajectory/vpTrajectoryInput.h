/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryInput.h
 * \brief Input and output of a trajectory, typed by the number of axes.
 */
#ifndef vpTrajectoryInput_h
#define vpTrajectoryInput_h

#include <visp3/trajectory/vpTrajectoryPlan.h>
#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <Eigen/Core>

#include <limits>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_trajectory
//! \brief One number per axis; \e N is the number of axes or Eigen::Dynamic.
template <int N> using vpAxisVector = Eigen::Matrix<double, N, 1>;

//! \ingroup group_trajectory
//! \brief Position (unit), velocity, acceleration and jerk of all axes.
template <int N> struct vpTrajectoryState {
  vpAxisVector<N> q; //!< Position.
  vpAxisVector<N> v; //!< Velocity.
  vpAxisVector<N> a; //!< Acceleration.
  vpAxisVector<N> j; //!< Jerk.

  //! All zero.
  explicit vpTrajectoryState(int axes = N == Eigen::Dynamic ? 0 : N) : q(vpAxisVector<N>::Zero(axes)), v(q), a(q), j(q)
  {}
};

//! \ingroup group_trajectory
//! \brief A point to pass at the fraction \e tau of the move, by default chosen by the planner.
template <int N> struct vpTrajectoryVia {
  double tau = vpAutomaticTau;  //!< Time as a fraction of the whole move, in (0, 1), ascending; or automatic in all.
  vpAxisVector<N> q;            //!< Position.
  vpAxisVector<N> v;            //!< Velocity at the via, if given.
  vpAxisVector<N> a;            //!< Acceleration at the via, if given.
  bool hasVelocity = false;     //!< \e v is given; otherwise it is chosen for least jerk.
  bool hasAcceleration = false; //!< \e a is given too; needs \e hasVelocity.

  //! Position only, at zero.
  explicit vpTrajectoryVia(int axes = N == Eigen::Dynamic ? 0 : N) : q(vpAxisVector<N>::Zero(axes)), v(q), a(q) {}
};

/*!
 * \ingroup group_trajectory
 * \brief Start, goal, limits, vias and options: everything that vpDirectTrajectory reads, each cycle.
 *
 * Any member may change at any cycle; that is an event. \e start is read in the first cycle and after reset() only.
 *
 * \code
 * vpTrajectoryInput<2> input;
 * input.goal.q << 0.6, 0.2;             // m
 * input.maxVelocity.setConstant(0.5);   // m/s
 * input.maxAcceleration.setConstant(2.); // m/s^2
 * vpTrajectoryVia<2> via;
 * via.q << 0.3, 0.4;
 * input.vias = {via};
 * const vpTrajectoryStatus status = vpDirectTrajectory<2>::optimiseVias(input); // when it is passed, and how fast
 * if (status.isGood()) {
 *   std::cout << "passed after " << input.vias[0].tau << " of the time" << std::endl;
 * }
 * vpDirectTrajectory<2> trajectory(2, 1); // with room for one via; then step(input, ...)
 * \endcode
 */
template <int N> struct vpTrajectoryInput {
  vpTrajectoryState<N> start;           //!< Initial state.
  vpTrajectoryState<N> goal;            //!< Final state. The jerk is read for vpTrajectoryContinuity::C3 only.
  vpAxisVector<N> maxVelocity;          //!< unit/s, > 0; infinity: none. Velocity or acceleration must be limited.
  vpAxisVector<N> maxAcceleration;      //!< unit/s^2, > 0; infinity: none.
  vpAxisVector<N> maxJerk;              //!< unit/s^3, > 0; infinity (the default): none.
  vpAxisVector<N> minPosition;          //!< unit; -infinity (the default): none.
  vpAxisVector<N> maxPosition;          //!< unit; infinity (the default): none.
  std::vector<vpTrajectoryVia<N>> vias; //!< Vias, at most the maxVias of the trajectory.
  vpTrajectorySpec spec;                //!< All other options.

  //! At rest at zero with velocity and acceleration limits of 1.
  explicit vpTrajectoryInput(int axes = N == Eigen::Dynamic ? 0 : N)
    : start(axes), goal(axes), maxVelocity(vpAxisVector<N>::Ones(axes)), maxAcceleration(maxVelocity),
      maxJerk(vpAxisVector<N>::Constant(axes, std::numeric_limits<double>::infinity())), minPosition(-maxJerk),
      maxPosition(maxJerk)
  {}

  /*!
   * Write into \e problem, which must have been made for this number of axes. Never allocates.
   * \return InvalidInput when a vector has the wrong length or there are too many vias, otherwise Working.
   */
  vpTrajectoryStatus copyTo(vpTrajectoryProblem &problem) const noexcept;
  //! Take times, and velocities and accelerations if given, of the vias of \e problem, which has the same vias.
  void takeVias(const vpTrajectoryProblem &problem) noexcept;
};

//! \ingroup group_trajectory
//! \brief Output of one cycle.
template <int N> struct vpTrajectoryOutput {
  vpTrajectoryState<N> state; //!< Commanded state.
  vpTrajectoryStatus status;  //!< Status of the step; status.message() is a sentence.
  double time = 0.;           //!< Time since the start of the current plan, s.
  double duration = 0.;       //!< Duration of the current plan, s.
  double remaining = 0.;      //!< Time to arrival, s.
  bool newPlan = false;       //!< This cycle made a plan.

  //! All zero.
  explicit vpTrajectoryOutput(int axes = N == Eigen::Dynamic ? 0 : N) : state(axes) {}
};

template <int N> vpTrajectoryStatus vpTrajectoryInput<N>::copyTo(vpTrajectoryProblem &problem) const noexcept
{
  using P = vpTrajectoryProblem;
  const int n = problem.axes();
  vpTrajectoryStatus status;
  status.result = vpTrajectoryResult::Working;
  const auto copy = [&](const vpAxisVector<N> &from, P::Field field) {
    if (from.size() == n) {
      std::copy_n(from.data(), n, problem.field(field));
    }
    else {
      status = {vpTrajectoryResult::InvalidInput, vpTrajectoryFault::AxisCount, n, static_cast<double>(from.size())};
    }
  };
  copy(start.q, P::StartQ);
  copy(start.v, P::StartV);
  copy(start.a, P::StartA);
  copy(start.j, P::StartJ);
  copy(goal.q, P::GoalQ);
  copy(goal.v, P::GoalV);
  copy(goal.a, P::GoalA);
  copy(goal.j, P::GoalJ);
  copy(maxVelocity, P::MaxVelocity);
  copy(maxAcceleration, P::MaxAcceleration);
  copy(maxJerk, P::MaxJerk);
  copy(minPosition, P::MinPosition);
  copy(maxPosition, P::MaxPosition);
  problem.spec = spec;
  problem.setViaCount(static_cast<int>(vias.size()));
  for (int k = 0; k < static_cast<int>(vias.size()) && k < problem.maxVias(); ++k) {
    const vpTrajectoryVia<N> &via = vias[static_cast<std::size_t>(k)];
    for (const vpAxisVector<N> *x : {&via.q, &via.v, &via.a}) {
      if (x->size() != n) {
        return {vpTrajectoryResult::InvalidInput, vpTrajectoryFault::AxisCount, n, static_cast<double>(x->size())};
      }
    }
    problem.setVia(k, via.tau, via.q.data(), via.hasVelocity ? via.v.data() : nullptr,
                   via.hasVelocity && via.hasAcceleration ? via.a.data() : nullptr);
  }
  return status;
}

template <int N> void vpTrajectoryInput<N>::takeVias(const vpTrajectoryProblem &problem) noexcept
{
  for (int k = 0; k < problem.vias(); ++k) {
    vpTrajectoryVia<N> &via = vias[static_cast<std::size_t>(k)];
    via.tau = problem.viaTime(k);
    via.hasVelocity = problem.viaOrder(k) >= 2;
    via.hasAcceleration = problem.viaOrder(k) >= 3;
    for (int i = 0; i < problem.axes(); ++i) {
      const vpAxisState x = problem.viaState(k, i);
      via.v[i] = via.hasVelocity ? x[1] : via.v[i];
      via.a[i] = via.hasAcceleration ? x[2] : via.a[i];
    }
  }
}

END_VISP_NAMESPACE
#endif
