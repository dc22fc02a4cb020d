/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDirectTrajectory.h
 * \brief Direct trajectory generation: where to be in the next cycle.
 */
#ifndef vpDirectTrajectory_h
#define vpDirectTrajectory_h

#include <visp3/core/vpException.h>
#include <visp3/trajectory/vpTrajectoryFollower.h>
#include <visp3/trajectory/vpTrajectoryInput.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpDirectTrajectory
 * \ingroup group_trajectory
 * \brief Moves N axes from any state to any state within limits that may change at any cycle, as smooth as a
 * minimum-jerk polynomial, with an answer in every case. Implements DTG, direct trajectory generation (thesis chapter
 * 6, corrected).
 *
 * \tparam N Number of axes, or Eigen::Dynamic to pass it to the constructor.
 *
 * \code
 * vpDirectTrajectory<3> trajectory;
 * vpTrajectoryInput<3> input;
 * vpTrajectoryOutput<3> output;
 * input.goal.q << 0.5, 0.2, -0.1;
 * input.maxVelocity.setConstant(0.5);
 * while (vpIsWorking(trajectory.step(input, output, 0.001))) {
 *   send(output.state.q); // input.goal or the limits may change here, at any cycle
 * }
 * if (output.status.result == vpTrajectoryResult::Finished) {
 *   send(output.state.q); // the goal itself
 * }
 * else {
 *   std::cerr << output.status.message(); // an error also ends the loop
 * }
 * \endcode
 *
 * Units are free but must be consistent for each axis. step() never allocates, throws, locks or prints. Copyable: a
 * copy carries the whole state of the motion.
 */
template <int N> class vpDirectTrajectory
{
public:
  /*!
   * \param axes : Number of axes; must be N unless N is Eigen::Dynamic.
   * \param maxVias : Maximum number of vias.
   * \throw vpException (badValue) naming the number that is out of range.
   */
  explicit vpDirectTrajectory(int axes = N, int maxVias = 0)
    : m_follower(checked(axes), maxVias), m_problem(axes, maxVias)
  {}

  //! One cycle of \e dt seconds (may vary): replan if something changed, then advance.
  vpTrajectoryResult step(const vpTrajectoryInput<N> &input, vpTrajectoryOutput<N> &output, double dt) noexcept
  {
    const vpTrajectoryStatus read = input.copyTo(m_problem);
    output.status = read.isGood() ? m_follower.step(m_problem, dt) : m_follower.advance(read, dt);
    for (int i = 0; i < m_problem.axes() && i < output.state.q.size(); ++i) {
      const vpAxisState x = m_follower.state(i);
      output.state.q[i] = x[0];
      output.state.v[i] = x[1];
      output.state.a[i] = x[2];
      output.state.j[i] = x[3];
    }
    output.time = m_follower.clock();
    output.duration = m_follower.plan().duration();
    output.remaining = m_follower.remaining();
    output.newPlan = m_follower.isNewPlan();
    return output.status.result;
  }

  //! The next step() starts from input.start.
  void reset() noexcept { m_follower.reset(); }
  //! The current plan: at(axis, t), peaks(axis), segments(axis), pieces().
  [[nodiscard]] const vpTrajectoryPlan &plan() const { return m_follower.plan(); }

  /*!
   * Plan the whole motion at once, from input.start to input.goal, without executing it, by the exact method.
   * Allocates.
   * \param input : The problem.
   * \param plan : Receives the motion; unchanged when the input is invalid.
   * \return Status of the plan, with a message.
   */
  static vpTrajectoryStatus calculate(const vpTrajectoryInput<N> &input, vpTrajectoryPlan &plan)
  {
    const int axes = static_cast<int>(input.goal.q.size());
    const int vias = static_cast<int>(input.vias.size());
    vpTrajectoryProblem problem(axes, vias);
    vpTrajectoryStatus status = input.copyTo(problem);
    status = status.isGood() ? problem.validate(true) : status;
    if (status.isGood()) {
      plan = vpTrajectoryPlan(axes, vias);
      const bool fixed = input.spec.policy == vpReplanPolicy::FixedArrival;
      status = vpTrajectoryPlanner(axes, vias)
                   .plan(problem, fixed ? input.spec.arrivalTime : input.spec.minimumDuration, plan);
    }
    return status;
  }

  /*!
   * Choose tau of each via, and the velocities where they are free, for a short duration of the whole motion; see
   * vpTrajectoryPlanner::optimiseVias(). Before the motion, not in the control loop. Allocates.
   * \param input : The problem; receives times and velocities of the vias where there are any to choose.
   * \return InvalidInput with a message, \e input is unchanged then; otherwise Working.
   */
  static vpTrajectoryStatus optimiseVias(vpTrajectoryInput<N> &input)
  {
    const int vias = static_cast<int>(input.vias.size());
    vpTrajectoryProblem problem(static_cast<int>(input.goal.q.size()), vias);
    vpTrajectoryStatus status = input.copyTo(problem);
    status = status.isGood() ? problem.validate(true) : status;
    if (status.isGood() && vpTrajectoryPlanner(problem.axes(), vias).optimiseVias(problem)) {
      input.takeVias(problem);
    }
    return status;
  }

private:
  static int checked(int axes)
  {
    if (N != Eigen::Dynamic && axes != N) {
      throw vpException(vpException::badValue, "a trajectory of %d axes was given %d axes", N, axes);
    }
    return axes;
  }

  vpTrajectoryFollower m_follower;
  vpTrajectoryProblem m_problem; // scratch: the input in flat storage
};

END_VISP_NAMESPACE
#endif
