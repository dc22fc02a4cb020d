/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryPlanner.h
 * \brief From a problem to a plan of the whole motion.
 */
#ifndef vpTrajectoryPlanner_h
#define vpTrajectoryPlanner_h

#include <visp3/trajectory/vpTrajectoryPlan.h>
#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <memory>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpTrajectoryPlanner
 * \ingroup group_trajectory
 * \brief Plans the motion of several axes from any state to any state within limits. Always returns a motion.
 *
 * Each axis gets a single polynomial of the exact smallest duration (vpMinimumDuration) when one exists; otherwise
 * acceleration ramps around a polynomial; when position or group limits exclude that too, it stops and restarts. Then
 * all axes are brought to one common duration, which is increased until every axis keeps its limits. "Smallest" means
 * within these forms, not over all motions.
 *
 * Has no state except scratch memory: the same problem gives the same plan. Allocates at construction only.
 *
 * \code
 * vpTrajectoryProblem problem(1);                              // axes
 * problem.field(vpTrajectoryProblem::GoalQ)[0] = 0.5;          // m
 * problem.field(vpTrajectoryProblem::MaxVelocity)[0] = 0.5;    // m/s
 * problem.field(vpTrajectoryProblem::MaxAcceleration)[0] = 2.; // m/s^2
 * vpTrajectoryPlanner planner(1);
 * vpTrajectoryPlan plan(1);
 * vpTrajectoryStatus status = problem.validate(true);
 * status = status.isGood() ? planner.plan(problem, 0., plan) : status;
 * std::cout << plan.duration() << " s; " << status.message() << std::endl;
 * \endcode
 */
class VISP_EXPORT vpTrajectoryPlanner
{
public:
  /*!
   * \throw vpException (badValue) when \e axes < 1 or \e maxVias < 0.
   */
  explicit vpTrajectoryPlanner(int axes, int maxVias = 0);
  ~vpTrajectoryPlanner();
  vpTrajectoryPlanner(const vpTrajectoryPlanner &other);            //!< Copies.
  vpTrajectoryPlanner &operator=(const vpTrajectoryPlanner &other); //!< Copies.
  vpTrajectoryPlanner(vpTrajectoryPlanner &&) noexcept;             //!< Moves.
  vpTrajectoryPlanner &operator=(vpTrajectoryPlanner &&) noexcept;  //!< Moves.

  /*!
   * Plan the whole motion. Never throws, never allocates.
   * \param problem : Valid, see vpTrajectoryProblem::validate().
   * \param floor : Minimum duration of the plan, s.
   * \param plan : Receives the motion.
   * \return Working, Braking, NoFeasibleDuration or ArrivalInfeasible (the value is then the earliest feasible
   *   arrival), decided by one exact check of all limits on the finished motion; the status gives the largest excess.
   *   With FixedArrival the floor is the arrival time.
   */
  vpTrajectoryStatus plan(const vpTrajectoryProblem &problem, double floor, vpTrajectoryPlan &plan) noexcept;

  /*!
   * A single polynomial per axis of this duration (clamped to 1e-9 ... 1e12 s), whatever the limits (figure 6.5, and
   * the thesis's iteration). The status reports any excess over the limits.
   */
  vpTrajectoryStatus planDirect(const vpTrajectoryProblem &problem, double T, vpTrajectoryPlan &plan) noexcept;

  /*!
   * Choose when each via is passed, and how fast where its velocity is free, for a short duration of the whole motion: by
   * looking at many motions, between 60 for one via and some 1000 for ten, before the motion, not in the control
   * loop. Allocates.
   * \param problem : Valid, with room for its vias in this planner; receives tau of each via, and velocities (of a
   *   single via also the acceleration) where they were free.
   * \return False when there is nothing to choose: no vias, straight lines from via to via, or no motion with one
   *   duration over all vias was found. \e problem is unchanged then.
   */
  bool optimiseVias(vpTrajectoryProblem &problem);

private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
