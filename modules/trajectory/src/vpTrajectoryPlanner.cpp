/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTrajectoryPlannerImpl.h"

#include "vpLimitCheck.h"

#include <visp3/trajectory/vpMotionForm.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

int orderOf(vpTrajectoryContinuity continuity) { return 2 + static_cast<int>(continuity); }
} // namespace

vpTrajectoryPlanner::Impl::Impl(int count, int maxVias)
  : n(count), from(static_cast<std::size_t>(count)), to(from),
    axes(static_cast<std::size_t>(count) + 1 + vpTrajectorySpec::maxGroups), units(static_cast<std::size_t>(count)),
    lines(static_cast<std::size_t>(count)), unitDurations(static_cast<std::size_t>(count)),
    direction(static_cast<std::size_t>(count)), spline(maxVias),
    chain(static_cast<std::size_t>(count) * (static_cast<std::size_t>(maxVias) + 1)),
    column(static_cast<std::size_t>(count)), legs(static_cast<std::size_t>(maxVias) + 1),
    taus(static_cast<std::size_t>(maxVias)), shares(legs.size()), bestShares(legs.size())
{
  for (vpCoupledAxes &unit : units) {
    unit.reserve(count);
  }
}

void vpTrajectoryPlanner::Impl::setTasks(const vpTrajectoryProblem &problem)
{
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    vpAxisTask &task = axis(i).task;
    task.order = orderOf(problem.spec.continuity);
    task.limits = problem.limits(i);
    // Positions are relative to the start of the leg: differences of near numbers are exact, and the digits stay.
    task.minPosition = task.limits.minPosition -= from[k][0];
    task.maxPosition = task.limits.maxPosition -= from[k][0];
    if (problem.spec.continuity == vpTrajectoryContinuity::C1) {
      task.limits.jerk = infinity; // the acceleration jumps anyway
    }
    if (problem.spec.policy == vpReplanPolicy::FixedArrival) {
      task.timeUnit = std::min(0.05, 0.1 * problem.spec.arrivalTime);
    }
    task.from = from[k];
    task.to = to[k];
    task.to[0] -= from[k][0];
    task.from[0] = 0.;
  }
  makeUnits(problem);
}

// One unit for every axis or group of axes under a norm.
void vpTrajectoryPlanner::Impl::makeUnits(const vpTrajectoryProblem &problem)
{
  unitCount = 0;
  straight = false;
  if (problem.spec.synchronisation == vpSynchronisation::Straight && addLine(problem, nullptr, axis(n))) {
    straight = true;
    return;
  }
  std::uint64_t grouped = 0;
  for (int g = 0; g < vpTrajectorySpec::maxGroups; ++g) {
    const vpAxisGroup &group = problem.spec.groups[static_cast<std::size_t>(g)];
    if (group.axes == 0) {
      continue;
    }
    grouped |= group.axes;
    if (isAtRest(group) && addLine(problem, &group, axis(n + 1 + g))) {
      continue;
    }
    vpCoupledAxes &unit = addUnit();
    unit.setNorm(problem.groupLimits(g));
    for (int i = 0; i < n; ++i) {
      if (group.contains(i)) {
        unit.add(&axis(i));
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    if (i >= 64 || (grouped >> i & 1) == 0) {
      addUnit().add(&axis(i));
    }
  }
}

vpCoupledAxes &vpTrajectoryPlanner::Impl::addUnit()
{
  lines[static_cast<std::size_t>(unitCount)] = {};
  vpCoupledAxes &unit = units[static_cast<std::size_t>(unitCount++)];
  unit.clear();
  return unit;
}

// At start and goal.
bool vpTrajectoryPlanner::Impl::isAtRest(const vpAxisGroup &group)
{
  bool rests = true;
  for (int i = 0; i < n; ++i) {
    rests = rests && !(group.contains(i) && axis(i).task.isMoving());
  }
  return rests;
}

// Several axes as one: motion along the straight line, with the tightest of their limits. Possible when the line is
// defined and every given derivative lies on it. All axes without a group.
bool vpTrajectoryPlanner::Impl::addLine(const vpTrajectoryProblem &problem, const vpAxisGroup *group,
                                        vpMotionAxis &carrier)
{
  const Line members{true, group};
  double length = 0.;
  for (int i = 0; i < n; ++i) {
    length = members.contains(i) ? std::hypot(length, axis(i).task.to[0]) : length;
  }
  vpAxisTask line;
  line.order = axis(0).task.order;
  line.timeUnit = axis(0).task.timeUnit;
  line.to[0] = length;
  line.minPosition = -infinity;
  line.maxPosition = infinity;
  for (int i = 0; i < n; ++i) {
    if (!members.contains(i)) {
      continue;
    }
    const vpAxisTask &task = axis(i).task;
    const double u = direction[static_cast<std::size_t>(i)] = length > 0. ? task.to[0] / length : 0.;
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
    const double a = task.minPosition / u, b = task.maxPosition / u;
    line.minPosition = std::max(line.minPosition, std::min(a, b));
    line.maxPosition = std::min(line.maxPosition, std::max(a, b));
  }
  bool onLine = true;
  for (int i = 0; i < n; ++i) {
    onLine = onLine && !(members.contains(i) && isAcross(axis(i).task, line, i));
  }
  if (!onLine || length == 0.) {
    return false;
  }
  for (int g = 0; g < vpTrajectorySpec::maxGroups; ++g) {
    const vpNormLimits limits = problem.groupLimits(g);
    double share = 0.;
    for (int i = 0; i < n; ++i) {
      const bool counts = members.contains(i) && problem.spec.groups[static_cast<std::size_t>(g)].contains(i);
      share = counts ? std::hypot(share, direction[static_cast<std::size_t>(i)]) : share;
    }
    if (share > 0.) {
      line.limits.velocity = std::min(line.limits.velocity, limits.velocity / share);
      line.limits.acceleration = std::min(line.limits.acceleration, limits.acceleration / share);
    }
  }
  carrier.task = line;
  addUnit().add(&carrier);
  lines[static_cast<std::size_t>(unitCount - 1)] = members;
  return true;
}

// The axis has a derivative off the line; reported as a fault.
bool vpTrajectoryPlanner::Impl::isAcross(const vpAxisTask &task, const vpAxisTask &line, int i)
{
  const auto a = static_cast<std::size_t>(i);
  const double u = direction[a];
  // The direction is a difference of positions, which are rounded.
  const double rounded = 4. * std::numeric_limits<double>::epsilon() * (std::abs(from[a][0]) + std::abs(to[a][0]));
  for (std::size_t k = 1; k < static_cast<std::size_t>(task.order); ++k) {
    const double pairs[2][2] = {{task.from[k], line.from[k]}, {task.to[k], line.to[k]}};
    for (const auto &x : pairs) {
      const double across = x[0] - u * x[1];
      const double slack = 1e-10 * std::abs(x[0]) + (line.to[0] > 0. ? rounded / line.to[0] * std::abs(x[1]) : 0.);
      if (!(std::abs(across) <= slack)) {
        fault.fault = vpTrajectoryFault::NotStraight;
        fault.index = i;
        fault.value = across;
        return true;
      }
    }
  }
  return false;
}

double vpTrajectoryPlanner::Impl::searchLeg(const vpTrajectorySpec &spec, double floor, bool independent)
{
  for (int u = 0; u < unitCount; ++u) {
    units[static_cast<std::size_t>(u)].prepare(spec.cruise);
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
    // Each time an axis takes another form, of which it has few, so this ends.
    // The one that is likely to be the slowest comes first: then the others look at its duration only.
    const auto last = units.begin() + unitCount;
    const auto first = std::max_element(units.begin(), last, [](const vpCoupledAxes &a, const vpCoupledAxes &b) {
      return a.estimate() < b.estimate();
    });
    int content = 0, i = static_cast<int>(first - units.begin());
    for (const int end = i + 100 * unitCount; content < unitCount && i < end; ++i) {
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
    const vpCoupledAxes &unit = units[static_cast<std::size_t>(u)];
    iterations = std::max(iterations, unit.iterations());
    if (unit.hasDroppedGoalAcceleration()) {
      const int i = firstAxis(u);
      fault = {vpTrajectoryResult::NoFeasibleDuration, vpTrajectoryFault::GoalContradiction, i,
               to[static_cast<std::size_t>(i)][2]};
    }
  }
}

int vpTrajectoryPlanner::Impl::firstAxis(int u) const
{
  const Line &line = lines[static_cast<std::size_t>(u)];
  int i = line.used ? 0 : static_cast<int>(units[static_cast<std::size_t>(u)].member(0) - axes.data());
  while (line.used && !line.contains(i)) {
    ++i;
  }
  return i;
}

double vpTrajectoryPlanner::Impl::groupBraking() const
{
  double longest = 0.;
  for (int u = 0; u < unitCount; ++u) {
    const vpCoupledAxes &unit = units[static_cast<std::size_t>(u)];
    longest = unit.hasNorm() ? std::max(longest, unit.brakingDuration()) : longest;
  }
  return longest;
}

// Append the current leg to the tracks.
void vpTrajectoryPlanner::Impl::emitLeg(vpTrajectoryPlan &plan, double begin, bool viaLeg)
{
  for (int u = 0; u < unitCount; ++u) {
    const vpCoupledAxes &unit = units[static_cast<std::size_t>(u)];
    const double T = unitDurations[static_cast<std::size_t>(u)];
    const Line &line = lines[static_cast<std::size_t>(u)];
    for (int m = 0; m < (line.used ? n : unit.count()); ++m) {
      const int i = line.used ? m : static_cast<int>(unit.member(m) - axes.data());
      if (line.used && !line.contains(i)) {
        continue;
      }
      if (!viaLeg) {
        plan.begin(i, from[static_cast<std::size_t>(i)][0], unit.form());
      }
      unit.emit(plan, line.used ? 0 : m, i, line.used ? direction[static_cast<std::size_t>(i)] : 1., T);
      plan.endLeg(i, begin + T);
    }
  }
}

void vpTrajectoryPlanner::Impl::finish(const vpTrajectoryProblem &problem, vpTrajectoryPlan &plan)
{
  for (int i = 0; i < n; ++i) {
    vpAxisState goal = problem.goal(i);
    const vpAxisState &planned = axis(straight ? n : i).task.to;
    const int given = 2 + static_cast<int>(problem.spec.continuity);
    for (int k = 2; k < 4; ++k) { // beyond the continuity, or dropped
      double &x = goal[static_cast<std::size_t>(k)];
      x = k >= given || planned[static_cast<std::size_t>(k)] == 0. ? 0. : x;
    }
    plan.finish(i, goal);
    coast(problem, i, goal, plan);
  }
  plan.setIterations(iterations);
}

// The axis's own ramp, or the common one of its group: at its end |v + a r/2| is at most the limit.
double vpTrajectoryPlanner::Impl::coastingRamp(const vpTrajectoryProblem &problem, int i) const
{
  const auto own = [&](int m) {
    const vpAxisTask &task = axes[static_cast<std::size_t>(m)].task;
    const vpAxisState goal = problem.goal(m);
    return goal[2] != 0. ? std::max(rampDuration(goal, task, std::min(task.order, 3)), 0.) : infinity;
  };
  double longest = own(i);
  for (int g = 0; g < vpTrajectorySpec::maxGroups; ++g) {
    const double limit = problem.groupLimits(g).velocity;
    if (!problem.spec.groups[static_cast<std::size_t>(g)].contains(i) || !std::isfinite(limit)) {
      continue;
    }
    double vv = 0., va = 0., aa = 0.;
    for (int m = 0; m < n; ++m) {
      const vpAxisState x = problem.goal(m);
      if (problem.spec.groups[static_cast<std::size_t>(g)].contains(m)) {
        vv += x[1] * x[1];
        va += x[1] * x[2];
        aa += x[2] * x[2];
        longest = std::min(longest, own(m));
      }
    }
    const double room = std::max(limit * limit - vv, 0.), root = std::sqrt(va * va + aa * room);
    longest = aa > 0. ? std::min(longest, va > 0. ? 2. * room / (root + va) : 2. * (root - va) / aa) : longest;
  }
  return longest;
}

// After the arrival: the acceleration goes down linearly, the velocity stays, and the axis brakes where it would leave
// its position limits otherwise.
void vpTrajectoryPlanner::Impl::coast(const vpTrajectoryProblem &problem, int i, const vpAxisState &goal,
                                      vpTrajectoryPlan &plan)
{
  if (goal[1] == 0. && goal[2] == 0.) {
    return;
  }
  const vpAxisTask &task = axis(i).task;
  const double r = goal[2] != 0. ? coastingRamp(problem, i) : 0.;
  vpAxisState x{goal[0], goal[1] + 0.5 * r * goal[2], 0., 0.};
  x[0] += r * (goal[1] + r * goal[2] / 3.);
  const double wall = from[static_cast<std::size_t>(i)][0] + (x[1] > 0. ? task.maxPosition : task.minPosition);
  const auto brakeFrom = [&](const vpAxisState &y) {
    return vpVelocityRamp(y[1], y[2], 0., task.brakeAcceleration(), task.brakeJerk(y));
  };
  vpVelocityRamp stop;
  double constant = infinity;
  if (x[1] != 0. && std::isfinite(wall)) {
    stop = brakeFrom(x);
    constant = (wall - stop.at(x[0], stop.duration())[0]) / x[1];
  }
  const vpPolynomial ramp{0., goal[1] * r, goal[2] * r * r / 2., -goal[2] * r * r / 6.};
  const double place = from[static_cast<std::size_t>(i)][0] - goal[0];
  const double low = std::min(task.minPosition + place, 0.), high = std::max(task.maxPosition + place, 0.);
  if (constant >= 0. && ramp.range().min >= low && ramp.range().max <= high) {
    plan.append(i, ramp, r);
    if (std::isfinite(constant)) {
      plan.append(i, {0., x[1] * constant}, constant);
      plan.appendRamp(i, stop, x);
      plan.rest(i);
    }
    return;
  }
  // No room for that: at once, and as hard as is needed. The norm of a group is for the usual stop only.
  const auto &groups = problem.spec.groups;
  const bool grouped = std::any_of(groups.begin(), groups.end(), [i](const vpAxisGroup &g) { return g.contains(i); });
  vpAxisTask hard = task;
  hard.order = 3;
  const double far = grouped ? infinity : 0.;
  const vpHardStop hardStop(goal, hard, low - far, high + far);
  x = goal;
  for (int k = 0; k < hardStop.count; ++k) {
    const double v = hardStop.velocities[static_cast<std::size_t>(k)];
    plan.appendRamp(i, vpVelocityRamp(x[1], x[2], v, hardStop.acceleration, hardStop.jerk), x);
    x = {0., v, 0., 0.};
  }
  plan.rest(i);
}

// When everything else fails: to rest, as fast as the limits allow.
void vpTrajectoryPlanner::Impl::stopAll(const vpTrajectoryProblem &problem, vpTrajectoryPlan &plan)
{
  plan.clear();
  fault = {vpTrajectoryResult::NoFeasibleDuration, vpTrajectoryFault::NoMotion, -1, 0.};
  for (int i = 0; i < n; ++i) {
    vpAxisTask task;
    task.limits = problem.limits(i);
    task.order = orderOf(problem.spec.continuity);
    task.from = problem.start(i);
    plan.begin(i, task.from[0], vpTrajectoryForm::StopAndGo);
    const vpVelocityRamp stop(task.from[1], task.from[2], 0., task.brakeAcceleration(), task.brakeJerk(task.from));
    plan.appendRamp(i, stop, task.from);
    plan.finish(i, {stop.at(task.from[0], stop.duration())[0], 0., 0., 0.});
  }
}

vpTrajectoryStatus vpTrajectoryPlanner::Impl::judge(const vpTrajectoryProblem &problem, vpTrajectoryPlan &plan)
{
  if (!plan.isFinite()) {
    stopAll(problem, plan);
  }
  double brakingEnd = 0.;
  vpTrajectoryStatus status = vpLimitCheck(problem, plan).judge(braking, brakingEnd);
  plan.setBrakingEnd(brakingEnd);
  const bool worse = fault.result == vpTrajectoryResult::NoFeasibleDuration;
  if (worse || (status.fault == vpTrajectoryFault::None && fault.fault != vpTrajectoryFault::None)) {
    status.result = worse ? fault.result : status.result;
    status.fault = fault.fault;
    status.index = fault.index;
    status.value = fault.value;
  }
  return status;
}

double vpTrajectoryPlanner::Impl::planPointToPoint(const vpTrajectoryProblem &problem, double floor,
                                                   vpTrajectoryPlan &plan)
{
  for (int i = 0; i < n; ++i) {
    from[static_cast<std::size_t>(i)] = problem.start(i);
    to[static_cast<std::size_t>(i)] = problem.goal(i);
  }
  setTasks(problem);
  const double T = searchLeg(problem.spec, floor, problem.spec.synchronisation == vpSynchronisation::None);
  emitLeg(plan, 0., false);
  braking = groupBraking();
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

// The scratch memory carries no state between calls.
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
  if (problem.spec.form != nullptr && problem.spec.form->isValid(problem, floor, plan)) {
    return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
  }
  Impl &d = *m_impl;
  plan.clear();
  d.begin();
  const double T = problem.vias() > 0 ? d.planVias(problem, floor, plan) : d.planPointToPoint(problem, floor, plan);
  d.finish(problem, plan);
  if (problem.spec.policy == vpReplanPolicy::FixedArrival && T > floor * (1. + 1e-9)) {
    vpTrajectoryStatus status = problem.spec.lateArrival == vpLateArrival::ExceedLimits
                                    ? planDirect(problem, floor, plan)
                                    : d.judge(problem, plan);
    if (d.fault.isGood()) { // an unreachable goal is worse
      status = {vpTrajectoryResult::ArrivalInfeasible, vpTrajectoryFault::ArrivalTooEarly, -1, T, status.excess};
    }
    return status;
  }
  return d.judge(problem, plan);
}

vpTrajectoryStatus vpTrajectoryPlanner::planDirect(const vpTrajectoryProblem &problem, double T,
                                                   vpTrajectoryPlan &plan) noexcept
{
  Impl &d = *m_impl;
  plan.clear();
  d.begin();
  d.takeTimes(problem);
  d.makeChain(problem);
  d.emitChain(problem, std::min(1e12, std::max(1e-9, T)), plan);
  d.finish(problem, plan);
  return d.judge(problem, plan);
}

END_VISP_NAMESPACE
