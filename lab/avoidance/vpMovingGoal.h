/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMovingGoal.h
 * \brief True and reported goal of an avoidance experiment.
 */
#ifndef vpMovingGoal_h
#define vpMovingGoal_h

#include "lab/avoidance/vpAvoidanceRunSpec.h"

#include <random>

BEGIN_VISP_NAMESPACE

//! \brief Goal moving along vpAvoidanceRunSpec::goalMoves.
class vpMovingGoal
{
public:
  explicit vpMovingGoal(const vpAvoidanceRunSpec &spec);

  //! True goal at time \e t, s; its velocity counts as 0.
  [[nodiscard]] vpAvoidanceGoal at(double t) const;
  //! True if a goal update is due at time \e t; the first is at 0. Call once per period.
  [[nodiscard]] bool isDue(double t);
  //! Reported goal: with noise, and with matching joints.
  [[nodiscard]] vpAvoidanceGoal told(double t);
  //! Time at which the goal comes to rest finally, s.
  [[nodiscard]] double end() const noexcept { return m_end; }

private:
  const vpAvoidanceRunSpec *m_spec;
  std::mt19937_64 m_random;
  double m_end;
  double m_next = 0.; // number of the next update
};

END_VISP_NAMESPACE
#endif
