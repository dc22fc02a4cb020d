/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlanSearch.h"

#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
// Stretch a little more than the excess says: durations do not scale every part of a motion alike.
constexpr double surplus = 1.005, leastStretch = 1.01, mostStretch = 3.;
// The same for a jerk: less of it lasts longer, and the other axes use more of theirs.
constexpr double jerkSurplus = 1.2;
// A longer duration mends the jerk of a join when it comes at least to this part.
constexpr double leastMending = 0.99;
constexpr double h = vpTwistSpline::knot;
// Of the speed limits, the part for new plans: the rest is for corrections of a plan that is as fast as it may be.
constexpr double fullness = 0.99;
// A correction that exceeds the limits is tried again with a duration longer by this at least; then a new plan is made.
constexpr double longerCorrection = 1.5;
constexpr int maxCorrections = 3;
constexpr double impossible = 1e6; // excess that no duration mends
constexpr double longest = 1e4;    // s; a plan of more control points is not verified
} // namespace

vpPlanSearch::vpPlanSearch(const vpServoMotionLimits &limits) : m_excess(limits), m_newExcess(limits)
{
  setLimits(limits);
}

void vpPlanSearch::setLimits(const vpServoMotionLimits &limits)
{
  m_limits = limits;
  m_newLimits = limits.slowed(fullness);
  m_excess = vpTwistExcess(m_limits);
  m_newExcess = vpTwistExcess(m_newLimits);
}

int vpPlanSearch::effort(double duration) const
{
  const double points = std::min(duration, longest) / h + 4.;
  return setCost + 2 * (2 * planCost + coarse) + static_cast<int>(points) * (m_check ? checkCost : 1);
}

void vpPlanSearch::open(const Task &task) noexcept
{
  m_task = task;
  m_floor = task.floor;
  m_tries = m_passed = 0;
  m_join = std::numeric_limits<double>::infinity();
  m_step = Step::Set;
  m_calls = 0;
  m_state = State::Busy;
}

// Instead of correcting the present plan.
void vpPlanSearch::planAnew() noexcept
{
  m_task.base = nullptr;
  m_tries = 0;
  m_floor = m_task.floor;
}

bool vpPlanSearch::setNext() noexcept
{
  if (m_task.base) {
    if (m_plan.correct(*m_task.base, m_task.since, m_task.start, m_floor)) {
      beginVerification();
      return true;
    }
    planAnew();
  }
  m_step = Step::Plan;
  return m_plan.set(m_task.start, m_task.origin, m_task.gaze, m_newLimits);
}

// Try again with a longer duration. The excess may be that of the join, which no duration mends.
bool vpPlanSearch::stretch(double excess) noexcept
{
  if (!(excess < impossible)) {
    return false;
  }
  const double factor = std::clamp(surplus * excess, leastStretch, mostStretch);
  if (m_task.base) {
    m_floor *= std::max(factor, longerCorrection);
    if (++m_tries == maxCorrections) {
      planAnew();
    }
    m_step = Step::Set;
    return true;
  }
  if (m_task.isAtRest) {
    m_plan.slowDown(factor);
  }
  else {
    m_floor = m_plan.duration() * factor;
  }
  m_step = Step::Plan;
  m_calls = 0;
  return true;
}

/*
 * A plan from an acceleration begins with the full jerk of each axis to end it, however long it takes. Together, and across the knot,
 * that is up to twice the limit. Less is left to the axes then, which takes longer: only where the plan need not arrive with the old one.
 */
bool vpPlanSearch::finishCandidate() noexcept
{
  const vpTwistNorms norms = vpTwistExcess::normsOf(m_task.before, m_task.last, m_plan.twist(1.5 * h), h);
  const vpTwistNorms share = norms / vpTwistExcess::normsOf(m_newLimits);
  const double linear = share[2], angular = share[5];
  const double worst = std::max(linear, angular);
  // Than the present plan to the same goal: with less jerk it would overshoot, and what is not found now is found soon.
  const bool isQuicker = !m_task.isFresh && m_task.floor == 0.;
  if (m_task.isAtRest || isQuicker || !(worst > 1.)) {
    return beginGlance();
  }
  if (!m_task.isFresh) {
    const bool isMending = worst < leastMending * m_join;
    m_join = worst;
    return isMending && beginGlance();
  }
  for (const auto &[part, jerk] :
       {std::pair(vpGazePlan::Position, linear), std::pair(vpGazePlan::Orientation, angular)}) {
    if (jerk > 1.) {
      m_plan.soften(part, jerkSurplus * jerk);
    }
  }
  m_step = Step::Plan;
  m_calls = 0;
  return true;
}

// The next candidate, part by part until both have the same duration: a longer one may be infeasible for the other part.
bool vpPlanSearch::planNext() noexcept
{
  if (m_calls++ == 0) {
    ++m_tries;
    m_common = m_floor;
    m_content = 0;
    m_part = vpGazePlan::Position;
  }
  const double T = m_plan.plan(m_part, m_common);
  if (m_tries > maxTries || m_calls > mostCalls || !(T < longest)) {
    return false;
  }
  m_content = T <= m_common * (1. + 1e-12) ? m_content + 1 : 1;
  m_common = std::max(m_common, T);
  m_part = m_part == vpGazePlan::Position ? vpGazePlan::Orientation : vpGazePlan::Position;
  return m_content < 2 || finishCandidate();
}

bool vpPlanSearch::beginGlance() noexcept
{
  const double step = std::max(h, m_plan.duration() / coarse);
  m_a = m_plan.twist(0.);
  m_b = m_plan.twist(step);
  m_worst = 0.;
  m_index = 2;
  m_last = static_cast<int>(m_plan.duration() / step) + 1;
  m_step = Step::Glance;
  return true;
}

// Differences over wider steps show at once most of what the verification would find.
bool vpPlanSearch::glanceNext() noexcept
{
  const double step = std::max(h, m_plan.duration() / coarse);
  const Vector6 next = m_plan.twist(m_index * step);
  m_worst = std::max(m_worst, limitExcess().of(vpTwistExcess::normsOf(m_a, m_b, next, step)));
  m_a = m_b;
  m_b = next;
  if (++m_index <= m_last) {
    return true;
  }
  if (!(m_worst <= leastStretch)) {
    return stretch(m_worst);
  }
  beginVerification();
  return true;
}

void vpPlanSearch::beginVerification() noexcept
{
  m_step = Step::Verify;
  m_worst = 0.;
  m_plan.forgetNorms();
  m_plan.noteNorms(3. * h,
                   vpTwistExcess::normsOf(m_limits)); // control points of the motion before it still have an effect
  m_index = m_check ? -std::max(m_task.wayCount - m_passed, 0) : 0;
  m_last = static_cast<int>(std::ceil(m_plan.duration() / h)) + 1;
  m_a = m_task.before;
  m_b = m_task.last;
  if (m_check) {
    m_check->begin();
  }
}

bool vpPlanSearch::verifyNext() noexcept
{
  if (m_index < 0) { // on the way to the start: for the robot only
    const double excess =
        m_check->add(vpTwistSpline::toTwist(m_task.way[static_cast<std::size_t>(m_task.wayCount + m_index)]), h);
    ++m_index;
    return excess < impossible;
  }
  ++m_index;
  const Vector6 next = m_plan.twist((m_index + 0.5) * h);
  const vpTwistNorms norms = vpTwistExcess::normsOf(m_a, m_b, next, h);
  double excess = limitExcess().of(norms);
  if (m_check) {
    const double robot = m_check->add(vpTwistSpline::toTwist(next), h);
    excess = robot <= excess ? excess : robot;
  }
  m_a = m_b;
  m_b = next;
  m_plan.noteNorms((m_index + 2) * h, norms);
  m_worst = excess <= m_worst ? m_worst : excess; // NaN stays
  if (!(m_worst < impossible)) {
    return false;
  }
  if (m_index < m_last) {
    return true;
  }
  m_plan.finishNorms();
  if (m_worst <= 1.) {
    m_state = State::Found;
    return true;
  }
  return stretch(m_worst);
}

int vpPlanSearch::cost() const
{
  switch (m_step) {
  case Step::Set:
    return setCost;
  case Step::Plan:
    return planCost;
  case Step::Glance:
    return 1;
  default:
    return m_check ? checkCost : 1;
  }
}

bool vpPlanSearch::advance() noexcept
{
  switch (m_step) {
  case Step::Set:
    return setNext();
  case Step::Plan:
    return planNext();
  case Step::Glance:
    return glanceNext();
  default:
    return verifyNext();
  }
}

void vpPlanSearch::work(int budget) noexcept
{
  do {
    if (m_state != State::Busy) {
      return;
    }
    budget -= cost();
    if (!advance()) {
      m_state = State::Failed;
    }
  } while (budget >= cost());
}

END_VISP_NAMESPACE
