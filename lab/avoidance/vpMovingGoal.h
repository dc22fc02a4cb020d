/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMovingGoal.h
 * \brief Where the goal of an avoidance experiment is, and what the method is told of it.
 */
#ifndef vpMovingGoal_h
#define vpMovingGoal_h

#include "lab/avoidance/vpAvoidanceRunSpec.h"

#include <random>

BEGIN_VISP_NAMESPACE

//! \brief The goal along vpAvoidanceRunSpec::goalMoves.
class vpMovingGoal
{
public:
  explicit vpMovingGoal(const vpAvoidanceRunSpec &spec);

  //! True goal at time \e t, s; its velocity counts as 0.
  [[nodiscard]] vpAvoidanceGoal at(double t) const;
  //! True when the method shall be told at time \e t; the first time is at 0. Call it once a period.
  [[nodiscard]] bool isDue(double t);
  //! What it is told then: with noise, and with joints that fit.
  [[nodiscard]] vpAvoidanceGoal told(double t);
  //! When the goal comes to rest for good, s.
  [[nodiscard]] double end() const noexcept { return m_end; }

private:
  const vpAvoidanceRunSpec *m_spec;
  std::mt19937_64 m_random;
  double m_end;
  double m_next = 0.; // number of the next telling
};

END_VISP_NAMESPACE
#endif
