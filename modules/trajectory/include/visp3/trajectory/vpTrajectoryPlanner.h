/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryPlanner.h
 * \brief From a problem to a plan: the whole motion at once.
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
 * \brief Plans the motion of several axes from any state to any state within limits. Always answers.
 *
 * Each axis gets a single polynomial of the exact smallest duration (vpMinimumDuration) when one exists; otherwise
 * acceleration ramps around a polynomial; when position or group limits rule that out too, it stops and goes. All axes
 * are then brought to one duration, which only ever grows, until every one of them keeps its limits at it. "Smallest"
 * means within these forms, not over all motions.
 *
 * Scratch memory only: two calls with the same problem give the same plan. Allocates at construction only.
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
   * Plan. Never throws, never allocates.
   * \param problem : Valid, see vpTrajectoryProblem::validate().
   * \param floor : No plan is shorter than this, s.
   * \param plan : Receives the motion.
   * \return Working, Braking, NoFeasibleDuration or ArrivalInfeasible (the value is then the earliest feasible arrival),
   *   decided by one exact check of all limits on the finished motion; the status tells the largest excess.
   *   With FixedArrival the floor is the arrival time.
   */
  vpTrajectoryStatus plan(const vpTrajectoryProblem &problem, double floor, vpTrajectoryPlan &plan) noexcept;

  /*!
   * A single polynomial per axis of this duration (clamped to 1e-9 ... 1e12 s), whatever the limits (figure 6.5, and the thesis's
   * iteration). The status tells what they have to say to it.
   */
  vpTrajectoryStatus planDirect(const vpTrajectoryProblem &problem, double T, vpTrajectoryPlan &plan) noexcept;

private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
