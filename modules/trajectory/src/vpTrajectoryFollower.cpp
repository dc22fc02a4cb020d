/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpTrajectoryFollower.h>

#include <visp3/trajectory/vpGoalJitter.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Duration of the rest-to-rest quintic over h that just keeps the limits.
double restDuration(double h, double velocity, double acceleration, double jerk)
{
  return std::max(
      {15. / 8. * h / velocity, std::sqrt(10. / std::sqrt(3.) * h / acceleration), std::cbrt(60. * h / jerk)});
}
} // namespace

vpGoalJitter::vpGoalJitter(int axes) : m_axes(static_cast<std::size_t>(std::max(axes, 0))) {}

void vpGoalJitter::reset() noexcept { std::fill(m_axes.begin(), m_axes.end(), Axis()); }

void vpGoalJitter::pass(double dt) noexcept
{
  const double fade = std::exp(-dt / memory);
  for (Axis &axis : m_axes) {
    axis.level *= fade;
  }
}

void vpGoalJitter::see(int axis, double surprise) noexcept
{
  if (!std::isfinite(surprise)) {
    return;
  }
  Axis &a = m_axes[static_cast<std::size_t>(axis)];
  if ((surprise < 0.) != (a.last < 0.)) {
    a.level = std::max(a.level, std::min(std::abs(surprise), std::abs(a.last)));
  }
  a.last = surprise;
}

double vpGoalJitter::level(int axis) const { return m_axes[static_cast<std::size_t>(axis)].level; }

double vpGoalJitter::floor(const vpTrajectoryProblem &problem) const noexcept
{
  double least = 0.;
  for (int i = 0; i < problem.axes(); ++i) {
    const vpAxisLimits limits = problem.limits(i);
    least = std::max(least, restDuration(level(i), limits.velocity, limits.acceleration, limits.jerk));
  }
  for (const vpAxisGroup &group : problem.spec.groups) {
    double norm = 0.;
    for (int i = 0; i < problem.axes(); ++i) {
      norm = group.contains(i) ? std::hypot(norm, level(i)) : norm;
    }
    least = norm > 0. ? std::max(least, restDuration(norm, group.maxSpeed, group.maxAcceleration,
                                                     std::numeric_limits<double>::infinity()))
                      : least;
  }
  return ease * least;
}

namespace
{
constexpr double longestStep = 1e9;                           // s
constexpr double shortestThesis = 1e-9, longestThesis = 1e12; // s

bool sameLimits(const vpTrajectoryProblem &a, const vpTrajectoryProblem &b)
{
  bool same = true;
  for (int i = 0; i < a.axes(); ++i) {
    const vpAxisLimits x = a.limits(i), y = b.limits(i);
    same = same && x.velocity == y.velocity && x.acceleration == y.acceleration && x.jerk == y.jerk &&
           x.minPosition == y.minPosition && x.maxPosition == y.maxPosition;
  }
  for (int g = 0; g < vpTrajectorySpec::maxGroups; ++g) {
    const vpNormLimits x = a.groupLimits(g), y = b.groupLimits(g);
    same = same && x.velocity == y.velocity && x.acceleration == y.acceleration;
  }
  return same;
}
} // namespace

vpTrajectoryFollower::vpTrajectoryFollower(int axes, int maxVias)
  : m_task(axes, maxVias), m_rest(axes, maxVias), m_planner(axes, maxVias), m_plan(axes, maxVias), m_jitter(axes)
{}

vpTrajectoryStatus vpTrajectoryFollower::step(const vpTrajectoryProblem &problem, double dt) noexcept
{
  m_newPlan = false;
  if (problem.axes() != m_plan.axes()) {
    return advance({vpTrajectoryResult::InvalidInput, vpTrajectoryFault::AxisCount, m_plan.axes(), 1. * problem.axes()},
                   dt);
  }
  if (!(dt > 0. && dt <= longestStep)) {
    return m_status = {vpTrajectoryResult::InvalidInput, vpTrajectoryFault::TimeStep, -1, dt};
  }
  const Event event = detect(problem);
  if (event == Event::Task) {
    const vpTrajectoryStatus input = problem.validate(!m_started);
    if (!input.isGood()) {
      return advance(input, dt);
    }
    replan(problem, event);
  }
  else if (m_thesisBusy) {
    iterateThesis();
  }
  else if (event == Event::Rate) {
    replan(problem, event);
  }
  const bool arrivedBefore = m_clock >= m_plan.duration() && !m_newPlan;
  tick(dt);
  return m_status = currentStatus(arrivedBefore);
}

vpTrajectoryStatus vpTrajectoryFollower::advance(const vpTrajectoryStatus &fault, double dt) noexcept
{
  m_newPlan = false;
  if (m_started && dt > 0. && dt <= longestStep) {
    tick(dt);
  }
  return m_status = fault;
}

void vpTrajectoryFollower::tick(double dt) noexcept
{
  m_clock += dt;
  m_sinceReplan += dt;
  m_goalAge += dt;
  m_jitter.pass(dt);
  // Sums of dt differ from the duration by rounding; that must not cost a cycle.
  if (std::abs(m_clock - m_plan.duration()) < 1e-8 * dt) {
    m_clock = m_plan.duration();
  }
}

vpTrajectoryFollower::Event vpTrajectoryFollower::detect(const vpTrajectoryProblem &problem) const noexcept
{
  if (!m_started) {
    return Event::Task;
  }
  const vpTrajectorySpec &spec = problem.spec;
  const bool frozen = remaining() > 0. && remaining() < spec.freeze;
  if (!problem.sameTask(m_task)) {
    // A fixed arrival cannot be delayed, and close to it no sensible change fits: the change waits for the arrival.
    // Other limits do not wait, because the status would not report them.
    const bool wait = spec.policy == vpReplanPolicy::FixedArrival && spec.arrivalTime == m_task.spec.arrivalTime &&
                      sameLimits(problem, m_task);
    return wait && frozen ? Event::None : Event::Task;
  }
  // A plan through vias stays: the rest of it is no motion that the planner would find again.
  const bool due = spec.replanPeriod > 0. && m_plan.vias() == 0 && m_sinceReplan >= spec.replanPeriod * (1. - 1e-9);
  return due && !frozen && remaining() > 0. ? Event::Rate : Event::None;
}

// The rest of the task from the commanded state: passed vias are dropped until the list of vias changes. The times of
// automatic vias are chosen again.
void vpTrajectoryFollower::takeRest(const vpTrajectoryProblem &problem) noexcept
{
  if (!m_started) {
    m_rest = problem;
    return;
  }
  if (problem.sameVias(m_task)) {
    int passed = 0;
    double begin = 0., tauBegin = 0.;
    while (passed < m_plan.vias() && m_plan.viaTime(passed) <= m_clock) {
      begin = m_plan.viaTime(passed);
      tauBegin = m_rest.viaTime(passed);
      ++passed;
    }
    if (problem.hasAutomaticVias()) {
      const int gone = problem.vias() - m_plan.vias() + passed;
      m_rest = problem;
      m_rest.dropVias(gone, 0.);
    }
    else {
      const bool last = passed >= m_plan.vias();
      const double end = last ? m_plan.duration() : m_plan.viaTime(passed);
      const double tauEnd = last ? 1. : m_rest.viaTime(passed);
      const double done =
          end > begin ? tauBegin + (tauEnd - tauBegin) * std::min((m_clock - begin) / (end - begin), 1.) : tauEnd;
      m_rest.dropVias(passed, done);
      m_rest.takeTask(problem);
    }
  }
  else {
    m_rest = problem;
  }
  for (int i = 0; i < m_rest.axes(); ++i) {
    m_rest.setStart(i, state(i));
  }
}

// Estimate the goal's motion from its changes.
void vpTrajectoryFollower::noteGoal(const vpTrajectoryProblem &problem) noexcept
{
  using P = vpTrajectoryProblem;
  if (!m_started) {
    m_jitter.reset();
    m_goalAge = m_goalInterval = 0.;
    m_goalMoves = false;
    return;
  }
  m_goalInterval = 0.;
  const double *q = problem.field(P::GoalQ), *v = problem.field(P::GoalV);
  const double *before = m_task.field(P::GoalQ), *rate = m_task.field(P::GoalV);
  if (std::equal(q, q + problem.axes(), before) && std::equal(v, v + problem.axes(), rate)) {
    return;
  }
  for (int i = 0; i < problem.axes(); ++i) {
    m_jitter.see(i, q[i] - before[i] - rate[i] * m_goalAge);
  }
  m_goalInterval = m_goalAge;
  m_goalAge = 0.;
  m_goalMoves = std::any_of(v, v + problem.axes(), [](double speed) { return speed != 0.; });
}

double vpTrajectoryFollower::floorOf(const vpTrajectoryProblem &problem, Event event) noexcept
{
  const vpTrajectorySpec &spec = problem.spec;
  if (spec.policy == vpReplanPolicy::FixedArrival) {
    // The arrival time stays while the goal is refined; when it could not be kept: as early as possible.
    const bool goesOn = m_started && remaining() > 0. && m_task.spec.policy == spec.policy &&
                        m_task.spec.arrivalTime == spec.arrivalTime;
    m_arrival = goesOn ? std::max(m_arrival - m_clock, 0.) : spec.arrivalTime;
    return m_arrival;
  }
  double left = m_started ? remaining() : 0.;
  if (spec.policy != vpReplanPolicy::KeepArrival) {
    return std::max(spec.minimumDuration, event == Event::Rate ? left : 0.);
  }
  if (m_goalMoves) {
    left = std::max(left - vpGoalJitter::hurry * m_goalInterval, 0.);
  }
  return std::max({spec.minimumDuration, left, m_jitter.floor(problem)});
}

// Predicted position of a moving goal at the end of the plan, within the position limits.
void vpTrajectoryFollower::aim() noexcept
{
  using P = vpTrajectoryProblem;
  const double ahead = m_goalAge + std::max(m_task.spec.minimumDuration, m_jitter.floor(m_task));
  for (int i = 0; i < m_rest.axes(); ++i) {
    const double there = m_task.field(P::GoalQ)[i] + m_task.field(P::GoalV)[i] * ahead;
    m_rest.field(P::GoalQ)[i] = std::clamp(there, m_task.field(P::MinPosition)[i], m_task.field(P::MaxPosition)[i]);
  }
}

bool vpTrajectoryFollower::isSinglePolynomial() const noexcept
{
  bool single = m_plan.form() == vpTrajectoryForm::Direct;
  for (int i = 0; i < m_plan.axes(); ++i) {
    single = single && m_plan.segments(i) == 1;
  }
  return single;
}

void vpTrajectoryFollower::replan(const vpTrajectoryProblem &problem, Event event) noexcept
{
  const double left = m_started ? remaining() : 0.;
  noteGoal(problem);
  const double floor = floorOf(problem, event);
  takeRest(problem);
  m_task = problem;
  m_started = true;
  m_newPlan = true;
  m_clock = m_sinceReplan = 0.;
  m_thesisBusy = problem.spec.method == vpDurationMethod::ThesisIteration;
  if (m_thesisBusy) {
    // (6.9) at the beginning, the remaining time at an event (6.8).
    m_thesisT = left;
    for (int i = 0; i < m_rest.axes() && left == 0.; ++i) {
      const vpAxisLimits limits = m_rest.limits(i);
      const double h = std::abs(m_rest.goal(i)[0] - m_rest.start(i)[0]);
      m_thesisT =
          std::max({m_thesisT, 15. / 8. * h / limits.velocity, std::sqrt(10. / std::sqrt(3.) * h / limits.acceleration),
                    vpMinimumDuration::lowerBound(m_rest.start(i), m_rest.goal(i), limits)});
    }
    iterateThesis();
    return;
  }
  if (problem.spec.policy == vpReplanPolicy::KeepArrival && m_goalMoves) {
    aim();
  }
  // Without an event, a single polynomial is replanned in the same form.
  m_planStatus = event == Event::Rate && isSinglePolynomial() ? m_planner.planDirect(m_rest, floor, m_plan)
                                                              : m_planner.plan(m_rest, floor, m_plan);
}

// Some steps of (6.6), from the commanded state, until no axis requests a change.
void vpTrajectoryFollower::iterateThesis() noexcept
{
  if (m_clock > 0.) {
    takeRest(m_task);
    m_thesisT = remaining();
    m_clock = 0.;
  }
  const vpTrajectorySpec &spec = m_rest.spec;
  const vpThesisDuration::Gains gains{spec.thesisVelocityGain, spec.thesisAccelerationGain};
  const int order = 2 + static_cast<int>(spec.continuity);
  bool converged = false;
  for (int step = 0; step < spec.thesisStepsPerCycle && !converged; ++step) {
    double extra = -0.5 * m_thesisT;
    for (int i = 0; i < m_rest.axes(); ++i) {
      const vpMotionFamily motion = vpMotionFamily::pointToPoint(m_rest.start(i), m_rest.goal(i), order);
      extra = std::max(extra, vpThesisDuration::extraTime(motion, m_rest.limits(i), gains, m_thesisT));
    }
    // Where the iteration diverges, the time is clamped to a valid range; NaN becomes the shortest.
    m_thesisT = std::min(longestThesis, std::max(shortestThesis, m_thesisT + extra));
    converged = std::abs(extra) < 1e-10 * m_thesisT;
  }
  m_thesisBusy = !converged && m_thesisT > spec.freeze;
  m_newPlan = true;
  m_planStatus = m_planner.planDirect(m_rest, m_thesisT, m_plan);
}

vpTrajectoryStatus vpTrajectoryFollower::currentStatus(bool arrivedBefore) const noexcept
{
  if (m_clock >= m_plan.duration()) {
    // A plan that exceeds its limits may do so after the arrival too.
    return {arrivedBefore ? vpTrajectoryResult::Holding : vpTrajectoryResult::Finished, vpTrajectoryFault::None, -1, 0.,
            m_planStatus.isGood() ? vpLimitExcess() : m_planStatus.excess};
  }
  if (m_planStatus.result == vpTrajectoryResult::Braking && m_clock >= m_plan.brakingEnd()) {
    return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
  }
  return m_planStatus;
}

END_VISP_NAMESPACE
