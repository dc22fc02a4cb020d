/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpMovingGoal.h"

#include "lab/avoidance/vpReachPoint.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr unsigned int stream = 0x60a1; // separate from those of the sensors

vpAvoidanceGoal between(const vpAvoidanceGoal &from, const vpAvoidanceGoal &to, double s)
{
  vpAvoidanceGoal goal;
  goal.position = from.position + s * (to.position - from.position);
  if (from.q.size() > 0 && from.q.size() == to.q.size()) {
    goal.q = from.q + s * (to.q - from.q);
  }
  return goal;
}
} // namespace

vpMovingGoal::vpMovingGoal(const vpAvoidanceRunSpec &spec)
  : m_spec(&spec), m_end(spec.goalMoves.empty() ? 0. : spec.goalMoves.back().end)
{
  std::seed_seq sequence{spec.seed, stream};
  m_random.seed(sequence);
}

vpAvoidanceGoal vpMovingGoal::at(double t) const
{
  vpAvoidanceGoal goal = m_spec->goal;
  for (const vpGoalMove &move : m_spec->goalMoves) {
    if (t < move.begin) {
      break;
    }
    goal = t < move.end ? between(goal, move.to, (t - move.begin) / (move.end - move.begin)) : move.to;
  }
  return goal;
}

bool vpMovingGoal::isDue(double t)
{
  constexpr double rounding = 1e-9;
  if (m_spec->goalMoves.empty() || t < m_next / m_spec->goalRate - rounding) {
    return false;
  }
  // Once more after the end, without noise, for the evaluation of the run.
  const bool due = m_next == 0. || (m_next - 1.) / m_spec->goalRate <= m_end;
  m_next += 1.;
  return due;
}

vpAvoidanceGoal vpMovingGoal::told(double t)
{
  vpAvoidanceGoal goal = at(t);
  if (m_spec->goalNoise > 0. && t <= m_end) {
    std::normal_distribution<double> normal(0., m_spec->goalNoise);
    for (int i = 0; i < 3; ++i) {
      goal.position(i) += normal(m_random);
    }
  }
  if (goal.q.size() > 0) {
    static_cast<void>(vpReachPoint(*m_spec->arm, goal.position, goal.q)); // as near as the arm can reach
  }
  return goal;
}

END_VISP_NAMESPACE
