/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTrajectoryPlannerImpl.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

int orderOf(vpTrajectoryContinuity continuity) { return 2 + static_cast<int>(continuity); }
} // namespace

vpTrajectoryPlanner::Impl::Impl(int count, int maxVias)
  : n(count), from(static_cast<std::size_t>(count)), to(from), axes(static_cast<std::size_t>(count) + 1),
    units(static_cast<std::size_t>(count)), unitDurations(static_cast<std::size_t>(count)),
    direction(static_cast<std::size_t>(count)), spline(maxVias),
    chain(static_cast<std::size_t>(count) * (static_cast<std::size_t>(maxVias) + 1)),
    column(static_cast<std::size_t>(count)), legs(static_cast<std::size_t>(maxVias) + 1)
{
  for (vpMotionUnit &unit : units) {
    unit.reserve(count);
  }
}

void vpTrajectoryPlanner::Impl::setTasks(const vpTrajectoryProblem &problem)
{
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    vpAxisTask &task = axis(i).task;
    task.order = orderOf(problem.options.continuity);
    task.limits = problem.limits(i);
    // Places count from the start of the leg: differences of near numbers are exact, and the digits stay.
    const double shift = problem.start(i)[0] - from[k][0];
    task.limits.minPosition = std::min(task.limits.minPosition + shift, 0.); // a start outside may come back
    task.limits.maxPosition = std::max(task.limits.maxPosition + shift, 0.);
    if (problem.options.continuity == vpTrajectoryContinuity::C1) {
      task.limits.jerk = infinity; // the acceleration jumps anyway
    }
    task.from = from[k];
    task.to = to[k];
    task.to[0] -= from[k][0];
    task.from[0] = 0.;
  }
  makeUnits(problem.options);
}

// One unit for every axis or group of axes under a norm.
void vpTrajectoryPlanner::Impl::makeUnits(const vpTrajectoryOptions &options)
{
  straight = options.synchronisation == vpSynchronisation::Straight && makeStraight(options);
  if (straight) {
    return;
  }
  unitCount = 0;
  std::uint64_t grouped = 0;
  for (const vpAxisGroup &group : options.groups) {
    if (group.axes == 0) {
      continue;
    }
    vpMotionUnit &unit = units[static_cast<std::size_t>(unitCount++)];
    unit.clear();
    unit.setNorm({group.maxSpeed, group.maxAcceleration});
    for (int i = 0; i < n; ++i) {
      if (group.contains(i)) {
        unit.add(&axis(i));
      }
    }
    grouped |= group.axes;
  }
  for (int i = 0; i < n; ++i) {
    if (i >= 64 || (grouped >> i & 1) == 0) {
      vpMotionUnit &unit = units[static_cast<std::size_t>(unitCount++)];
      unit.clear();
      unit.add(&axis(i));
    }
  }
}

// All axes as one: the way along the straight line, with the tightest of their limits. Possible when the line is defined
// and every given derivative lies on it.
bool vpTrajectoryPlanner::Impl::makeStraight(const vpTrajectoryOptions &options)
{
  double length = 0.;
  for (int i = 0; i < n; ++i) {
    length = std::hypot(length, axis(i).task.to[0]);
  }
  if (length == 0.) {
    return false;
  }
  vpAxisTask line;
  line.order = axis(0).task.order;
  line.to[0] = length;
  for (int i = 0; i < n; ++i) {
    const vpAxisTask &task = axis(i).task;
    const double u = direction[static_cast<std::size_t>(i)] = task.to[0] / length;
    for (std::size_t k = 1; k < 4; ++k) {
      line.from[k] += u * task.from[k];
      line.to[k] += u * task.to[k];
    }
    if (u == 0.) {
      continue;
    }
    line.limits.velocity = std::min(line.limits.velocity, task.limits.velocity / std::abs(u));
    line.limits.acceleration = std::min(line.limits.acceleration, task.limits.acceleration / std::abs(u));
    line.limits.jerk = std::min(line.limits.jerk, task.limits.jerk / std::abs(u));
    const double a = task.limits.minPosition / u, b = task.limits.maxPosition / u;
    line.limits.minPosition = std::max(line.limits.minPosition, std::min(a, b));
    line.limits.maxPosition = std::min(line.limits.maxPosition, std::max(a, b));
  }
  for (std::size_t k = 1; k < 4; ++k) {
    for (int i = 0; i < n; ++i) {
      const vpAxisTask &task = axis(i).task;
      const double u = direction[static_cast<std::size_t>(i)];
      const double slack = 1e-9 * (std::abs(line.from[k]) + std::abs(line.to[k]));
      if (std::abs(task.from[k] - u * line.from[k]) > slack || std::abs(task.to[k] - u * line.to[k]) > slack) {
        return false;
      }
    }
  }
  for (const vpAxisGroup &group : options.groups) {
    double share = 0.;
    for (int i = 0; i < n; ++i) {
      share = group.contains(i) ? std::hypot(share, direction[static_cast<std::size_t>(i)]) : share;
    }
    if (share > 0.) {
      line.limits.velocity = std::min(line.limits.velocity, group.maxSpeed / share);
      line.limits.acceleration = std::min(line.limits.acceleration, group.maxAcceleration / share);
    }
  }
  axis(n).task = line;
  unitCount = 1;
  units[0].clear();
  units[0].add(&axis(n));
  return true;
}

double vpTrajectoryPlanner::Impl::searchLeg(const vpTrajectoryOptions &options, double floor, bool independent)
{
  for (int u = 0; u < unitCount; ++u) {
    units[static_cast<std::size_t>(u)].prepare(options.cruise);
  }
  double T = floor;
  if (independent) {
    for (int u = 0; u < unitCount; ++u) {
      double &own = unitDurations[static_cast<std::size_t>(u)];
      own = units[static_cast<std::size_t>(u)].next(floor);
      T = std::max(T, own);
    }
  }
  else {
    // To a fixed point from below: a longer duration may be infeasible for an axis that was content with a shorter one.
    int content = 0;
    for (int i = 0; content < unitCount && i < 100 * unitCount; ++i) {
      const double next = units[static_cast<std::size_t>(i % unitCount)].next(T);
      content = next == T ? content + 1 : 1;
      T = next;
    }
    std::fill_n(unitDurations.begin(), unitCount, T);
  }
  noteFaults();
  return T;
}

void vpTrajectoryPlanner::Impl::noteFaults()
{
  for (int u = 0; u < unitCount; ++u) {
    const vpMotionUnit &unit = units[static_cast<std::size_t>(u)];
    iterations = std::max(iterations, unit.iterations());
    if (unit.hasDroppedPosition() || unit.hasDroppedGoalAcceleration()) {
      const int i = straight ? 0 : static_cast<int>(unit.member(0) - axes.data());
      const bool position = unit.hasDroppedPosition();
      fault = {vpTrajectoryResult::NoFeasibleDuration,
               position ? vpTrajectoryFault::PositionUnreachable : vpTrajectoryFault::GoalContradiction, i,
               position ? from[static_cast<std::size_t>(i)][0] : to[static_cast<std::size_t>(i)][2]};
    }
  }
}

// Append the present leg to the tracks.
void vpTrajectoryPlanner::Impl::emitLeg(vpTrajectoryPlan &plan, bool viaLeg)
{
  for (int u = 0; u < unitCount; ++u) {
    const vpMotionUnit &unit = units[static_cast<std::size_t>(u)];
    const double T = unitDurations[static_cast<std::size_t>(u)];
    for (int m = 0; m < (straight ? n : unit.count()); ++m) {
      const int i = straight ? m : static_cast<int>(unit.member(m) - axes.data());
      if (!viaLeg) {
        plan.begin(i, from[static_cast<std::size_t>(i)][0], unit.form());
      }
      unit.emit(plan, straight ? 0 : m, i, straight ? direction[static_cast<std::size_t>(i)] : 1., T);
    }
  }
}

void vpTrajectoryPlanner::Impl::finish(const vpTrajectoryProblem &problem, vpTrajectoryPlan &plan)
{
  for (int i = 0; i < n; ++i) {
    vpAxisState goal = problem.goal(i);
    if (fault.fault == vpTrajectoryFault::GoalContradiction && axis(i).task.to[2] == 0.) {
      goal[2] = goal[3] = 0.;
    }
    if (problem.options.continuity == vpTrajectoryContinuity::C1) {
      goal[2] = goal[3] = 0.;
    }
    plan.finish(i, goal, std::max(rampDuration(goal, axis(i).task), 0.));
  }
  plan.setIterations(iterations);
}

double vpTrajectoryPlanner::Impl::planPointToPoint(const vpTrajectoryProblem &problem, double floor,
                                                   vpTrajectoryPlan &plan)
{
  for (int i = 0; i < n; ++i) {
    from[static_cast<std::size_t>(i)] = problem.start(i);
    to[static_cast<std::size_t>(i)] = problem.goal(i);
  }
  setTasks(problem);
  const double T = searchLeg(problem.options, floor, problem.options.synchronisation == vpSynchronisation::None);
  emitLeg(plan, false);
  double braking = 0.;
  for (int u = 0; u < unitCount; ++u) {
    braking = std::max(braking, units[static_cast<std::size_t>(u)].brakingDuration());
  }
  plan.setBrakingEnd(braking);
  return T;
}

vpTrajectoryPlanner::vpTrajectoryPlanner(int axes, int maxVias)
{
  static_cast<void>(vpTrajectoryPlan(axes, maxVias)); // validates
  m_impl = std::make_unique<Impl>(axes, maxVias);
}

vpTrajectoryPlanner::~vpTrajectoryPlanner() = default;
vpTrajectoryPlanner::vpTrajectoryPlanner(vpTrajectoryPlanner &&) noexcept = default;
vpTrajectoryPlanner &vpTrajectoryPlanner::operator=(vpTrajectoryPlanner &&) noexcept = default;

// Nothing in the scratch memory outlives a call.
vpTrajectoryPlanner::vpTrajectoryPlanner(const vpTrajectoryPlanner &other)
  : m_impl(std::make_unique<Impl>(other.m_impl->n, static_cast<int>(other.m_impl->legs.size()) - 1))
{}

vpTrajectoryPlanner &vpTrajectoryPlanner::operator=(const vpTrajectoryPlanner &other)
{
  *this = vpTrajectoryPlanner(other);
  return *this;
}

vpTrajectoryStatus vpTrajectoryPlanner::plan(const vpTrajectoryProblem &problem, double floor,
                                             vpTrajectoryPlan &plan) noexcept
{
  Impl &d = *m_impl;
  plan.clear();
  d.fault = {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
  d.iterations = 0;
  const double T = problem.vias() > 0 ? d.planVias(problem, floor, plan) : d.planPointToPoint(problem, floor, plan);
  d.finish(problem, plan);
  if (problem.options.policy == vpReplanPolicy::FixedArrival && T > floor * (1. + 1e-9)) {
    if (problem.options.lateArrival == vpLateArrival::ExceedLimits) {
      planDirect(problem, floor, plan);
    }
    return {vpTrajectoryResult::ArrivalInfeasible, vpTrajectoryFault::ArrivalTooEarly, -1, T};
  }
  if (d.fault.isGood() && plan.brakingEnd() > 0.) {
    d.fault.result = vpTrajectoryResult::Braking;
  }
  return d.fault;
}

void vpTrajectoryPlanner::planDirect(const vpTrajectoryProblem &problem, double T, vpTrajectoryPlan &plan) noexcept
{
  Impl &d = *m_impl;
  plan.clear();
  d.fault = {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
  d.makeChain(problem);
  d.emitChain(problem, T, plan);
  d.finish(problem, plan);
}

END_VISP_NAMESPACE
