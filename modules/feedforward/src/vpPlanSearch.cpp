/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlanSearch.h"

BEGIN_VISP_NAMESPACE

namespace
{
// Stretch a little more than the excess says: durations do not scale every part of a motion alike.
constexpr double surplus = 1.005, leastStretch = 1.01, mostStretch = 3.;
constexpr double h = vpTwistSpline::knot;
constexpr double impossible = 1e6; // excess that no duration mends
constexpr double longest = 1e4;    // s; a plan of more control points is not verified
} // namespace

int vpPlanSearch::effort(double duration) const
{
  const double points = std::min(duration, longest) / h + 4.;
  return 2 * (planCost + coarse) + static_cast<int>(points) * (m_check ? checkCost : 1);
}

void vpPlanSearch::open(const Task &task) noexcept
{
  m_task = task;
  m_floor = task.floor;
  m_tries = 0;
  m_planned = false;
  m_state = m_plan.set(task.start, task.origin, task.gaze, m_limits) ? State::Busy : State::Failed;
}

// Try again with a longer duration. The excess may be that of the join, which no duration mends.
bool vpPlanSearch::stretch(double excess) noexcept
{
  if (!(excess < impossible)) {
    return false;
  }
  const double factor = std::clamp(surplus * excess, leastStretch, mostStretch);
  if (m_task.isAtRest) {
    m_plan.slowDown(factor);
  }
  else {
    m_floor = m_plan.duration() * factor;
  }
  m_planned = false;
  return true;
}

// The next candidate. Differences over wider steps show at once most of what the verification would find.
bool vpPlanSearch::propose() noexcept
{
  if (++m_tries > maxTries || !m_plan.plan(m_floor) || !(m_plan.duration() < longest)) {
    return false;
  }
  const double step = std::max(h, m_plan.duration() / coarse);
  double excess = 0.;
  Vector6 a = m_plan.twist(0.), b = m_plan.twist(step);
  for (double time = 2. * step; time <= m_plan.duration() + step; time += step) {
    const Vector6 next = m_plan.twist(time);
    excess = std::max(excess, m_excess.of(a, b, next, step));
    a = b;
    b = next;
  }
  if (!(excess <= leastStretch)) {
    return stretch(excess);
  }
  m_planned = true;
  m_worst = 0.;
  m_plan.forgetSpeeds();
  m_plan.noteSpeed(0., m_task.before);
  m_plan.noteSpeed(0., m_task.last);
  m_index = m_check ? -m_task.wayCount : 0;
  m_last = static_cast<int>(std::ceil(m_plan.duration() / h)) + 1;
  m_a = m_task.before;
  m_b = m_task.last;
  if (m_check) {
    m_check->begin();
  }
  return true;
}

void vpPlanSearch::verifyNext() noexcept
{
  if (m_index < 0) { // on the way to the start: for the robot only
    const double excess =
        m_check->add(vpTwistSpline::toTwist(m_task.way[static_cast<std::size_t>(m_task.wayCount + m_index)]), h);
    ++m_index;
    if (!(excess < impossible)) {
      m_state = State::Failed;
    }
    return;
  }
  ++m_index;
  const Vector6 next = m_plan.twist((m_index + 0.5) * h);
  double excess = m_excess.of(m_a, m_b, next, h);
  if (m_check) {
    const double robot = m_check->add(vpTwistSpline::toTwist(next), h);
    excess = robot <= excess ? excess : robot;
  }
  m_a = m_b;
  m_b = next;
  m_plan.noteSpeed((m_index - 1) * h, next);      // it has an effect from there on
  m_worst = excess <= m_worst ? m_worst : excess; // NaN stays
  if (!(m_worst < impossible)) {
    m_state = State::Failed;
  }
  else if (m_index >= m_last) {
    m_plan.finishSpeeds();
    m_state = m_worst <= 1. ? State::Found : stretch(m_worst) ? State::Busy : State::Failed;
  }
}

void vpPlanSearch::work(int budget) noexcept
{
  while (m_state == State::Busy && budget > 0) {
    if (m_planned) {
      verifyNext();
      budget -= m_check ? checkCost : 1;
    }
    else {
      m_state = propose() ? State::Busy : State::Failed;
      budget -= planCost + coarse;
    }
  }
}

END_VISP_NAMESPACE
