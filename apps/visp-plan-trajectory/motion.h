/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file motion.h
 * \brief From a problem to the motion that a robot would execute, event by event.
 */
#ifndef planTrajectory_motion_h
#define planTrajectory_motion_h

#include "problemLine.h"

#include <visp3/trajectory/vpTrajectoryPlan.h>

#include <string>
#include <vector>

namespace planTrajectory
{
//! \brief A plan and the time in which it was in force.
struct PlanInForce {
  double begin = 0.;         //!< s from the start of the motion.
  double end = 0.;           //!< s; until the next plan, or the arrival.
  vpTrajectoryPlan plan{1};  //!< On its own clock, which is 0 at #begin.
  vpTrajectoryStatus status; //!< What the planner said.
};

//! \brief The motion that was executed, from its start to the last arrival.
struct Motion {
  std::vector<PlanInForce> plans;                           //!< One after another, at least one.
  std::vector<vpTrajectoryPiece> pieces;                    //!< The executed polynomials, on the clock of the motion.
  std::vector<vpTrajectoryPeaks> peaks;                     //!< Per axis, exact, over #pieces.
  vpTrajectoryForm form = vpTrajectoryForm::Hold;           //!< The worst of all plans.
  vpTrajectoryResult result = vpTrajectoryResult::Finished; //!< The worst of all plans; Working counts as Finished.
  vpLimitExcess excess;                                     //!< Of the plan that #result is of.
  std::string message;                                      //!< A sentence.

  [[nodiscard]] double duration() const { return plans.back().end; } //!< s.
  //! State of an axis at time \e t, 0 <= t <= duration().
  [[nodiscard]] vpAxisState at(int axis, double t) const;
};

//! The most control cycles that one motion may take.
constexpr double maxCycles = 1e7;

/*!
 * Execute a problem: without events a whole plan at once, else cycle by cycle as vpDirectTrajectory does in a control
 * loop. An event that falls between two cycles is taken at its very instant, by a shorter cycle.
 * \throw std::runtime_error: one sentence with place, axis and value when the input is invalid or needs more than
 * maxCycles cycles.
 */
[[nodiscard]] Motion execute(const Problem &problem);
} // namespace planTrajectory

#endif
