/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file motion.h
 * \brief From a problem to the motion executed by a robot, event by event.
 */
#ifndef planTrajectory_motion_h
#define planTrajectory_motion_h

#include "problemLine.h"

#include <visp3/trajectory/vpTrajectoryPlan.h>

#include <string>
#include <vector>

namespace planTrajectory
{
//! \brief A plan and the time during which it was active.
struct PlanInForce {
  double begin = 0.;         //!< s from the start of the motion.
  double end = 0.;           //!< s; start of the next plan, or arrival.
  vpTrajectoryPlan plan{1};  //!< Its own time is 0 at #begin.
  vpTrajectoryStatus status; //!< Status returned by the planner.
};

//! \brief The executed motion, from its start to the last arrival.
struct Motion {
  std::vector<PlanInForce> plans;                           //!< Consecutive plans, at least one.
  std::vector<vpTrajectoryPiece> pieces;                    //!< The executed polynomials, in the time of the motion.
  std::vector<vpTrajectoryPeaks> peaks;                     //!< Per axis, exact, over #pieces.
  vpTrajectoryForm form = vpTrajectoryForm::Hold;           //!< The worst of all plans.
  vpTrajectoryResult result = vpTrajectoryResult::Finished; //!< The worst of all plans; Working counts as Finished.
  vpLimitExcess excess;                                     //!< Limit excess of the plan that gave #result.
  std::string message;                                      //!< A sentence.

  [[nodiscard]] double duration() const { return plans.back().end; } //!< s.
  //! State of an axis at time \e t, 0 <= t <= duration().
  [[nodiscard]] vpAxisState at(int axis, double t) const;
};

//! Maximum number of control cycles of a motion.
constexpr double maxCycles = 1e7;

/*!
 * Execute a problem: without events a whole plan at once, else cycle by cycle as vpDirectTrajectory does in a control
 * loop. An event between two cycles takes effect at its exact time, by a shorter cycle.
 * \throw std::runtime_error: one sentence with location, axis and value if the input is invalid or needs more than
 * maxCycles cycles.
 */
[[nodiscard]] Motion execute(const Problem &problem);
} // namespace planTrajectory

#endif
