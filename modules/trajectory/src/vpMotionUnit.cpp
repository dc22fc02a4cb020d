/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMotionUnit.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
}

void vpMotionUnit::reserve(int axes)
{
  m_members.resize(static_cast<std::size_t>(axes));
  m_steps.resize(static_cast<std::size_t>(axes));
  m_families.resize(static_cast<std::size_t>(axes));
}

void vpMotionUnit::clear() noexcept
{
  m_count = 0;
  m_hasNorm = false;
}

void vpMotionUnit::prepare(bool allowCruise) noexcept
{
  m_allowCruise = allowCruise && isSingle();
  m_droppedGoal = m_rampedReady = m_softReady = m_lastBuilt = m_lastReady = m_freeReady = false;
  m_iterations = 0;
  m_braking = 0.;
  bool outside = m_hasNorm && breaksNorm();
  for (int i = 0; i < m_count; ++i) {
    at(i).direct.open(at(i).task);
    outside = outside || needsBraking(at(i).task);
  }
  m_tailRamp = commonRamp(false);
  if (m_tailRamp < 0.) {
    dropGoalAcceleration();
  }
  m_headRamp = outside ? 0. : commonRamp(true);
  if (outside || m_headRamp < 0.) {
    brake();
    m_headRamp = 0.; // braking ends with zero acceleration
  }
  boundPositions();
  close(&vpMotionAxis::direct);
  if (m_allowCruise) {
    at(0).cruise.open(at(0).task, at(0).direct);
  }
  m_own = infinity;
  if (isOutside()) {
    const double own = search(&vpMotionAxis::direct, 0.);
    m_own = own < infinity ? own * (1. + 1e-9) : 0.;
  }
}

void vpMotionUnit::dropGoalAcceleration() noexcept
{
  m_droppedGoal = true;
  m_tailRamp = 0.;
  for (int i = 0; i < m_count; ++i) {
    vpAxisTask &task = at(i).task;
    task.to[2] = task.to[3] = 0.;
    at(i).direct.open(task);
  }
}

void vpMotionUnit::close(Form form) noexcept
{
  for (int i = 0; i < m_count; ++i) {
    (at(i).*form).close(at(i).task);
  }
}

// No form leaves the span of start and goal by more than the braking distance, nor goes beyond the position limits
// unless the last resort has to.
void vpMotionUnit::boundPositions() noexcept
{
  bool monotone = m_braking == 0. && !isOutside();
  for (int i = 0; i < m_count; ++i) {
    monotone = monotone && !at(i).task.isMoving();
  }
  if (!monotone) {
    buildLast();
  }
  for (int i = 0; i < m_count; ++i) {
    vpAxisTask &task = at(i).task;
    double &low = task.limits.minPosition, &high = task.limits.maxPosition;
    if (monotone) {
      low = -infinity;
      high = infinity;
      continue;
    }
    double lastLow = 0., lastHigh = 0.;
    const double distance = task.hasBrakingDistance() ? (at(i).*m_last).brakingDistance(task.to[0]) : infinity;
    (at(i).*m_last).hull(lastLow, lastHigh);
    at(i).freeLow = std::min(lastLow, task.minPosition);
    at(i).freeHigh = std::max(lastHigh, task.maxPosition);
    low = std::min(lastLow, std::max(task.minPosition, std::min(0., task.to[0]) - distance));
    high = std::max(lastHigh, std::min(task.maxPosition, std::max(0., task.to[0]) + distance));
  }
  if (m_rampedReady) { // built on the way, within other bounds
    close(&vpMotionAxis::ramped);
    close(&vpMotionAxis::soft);
  }
}

bool vpMotionUnit::isOutside() const noexcept
{
  for (int i = 0; i < m_count; ++i) {
    if (at(i).task.minPosition > 0. || at(i).task.maxPosition < 0.) {
      return true;
    }
  }
  return false;
}

// As far as start and goal do.
bool vpMotionUnit::keepsPositions(Form form) const noexcept
{
  for (int i = 0; i < m_count; ++i) {
    const vpAxisTask &task = at(i).task;
    double low = 0., high = 0.;
    (at(i).*form).hull(low, high);
    if (low < std::min({task.minPosition, 0., task.to[0]}) || high > std::max({task.maxPosition, 0., task.to[0]})) {
      return false;
    }
  }
  return true;
}

bool vpMotionUnit::breaksNorm() const noexcept
{
  const double slack = 1. + 1e-12;
  double v2 = 0., a2 = 0.;
  for (int i = 0; i < m_count; ++i) {
    const vpAxisState &x = m_members[static_cast<std::size_t>(i)]->task.from;
    v2 += x[1] * x[1];
    a2 += x[2] * x[2];
  }
  return std::sqrt(v2) > m_norm.velocity * slack || std::sqrt(a2) > m_norm.acceleration * slack;
}

// All members come back inside together: their velocities keep their proportions.
void vpMotionUnit::brake() noexcept
{
  const auto naturalTarget = [](const vpAxisTask &task) {
    const double a = task.order > 2 ? task.from[2] : 0.;
    const double end = task.from[1] + a * std::abs(a) / (2. * task.brakeJerk(task.from));
    return std::clamp(end, -task.limits.velocity, task.limits.velocity);
  };
  double norm2 = 0.;
  for (int i = 0; i < m_count; ++i) {
    const double target = naturalTarget(m_members[static_cast<std::size_t>(i)]->task);
    norm2 += target * target;
  }
  const double shrink = m_hasNorm && std::sqrt(norm2) > m_norm.velocity ? m_norm.velocity / std::sqrt(norm2) : 1.;
  for (int i = 0; i < m_count; ++i) {
    const vpAxisTask &task = m_members[static_cast<std::size_t>(i)]->task;
    const vpVelocityRamp ramp(task.from[1], task.order > 2 ? task.from[2] : 0., shrink * naturalTarget(task),
                              task.brakeAcceleration(), task.brakeJerk(task.from));
    m_braking = std::max(m_braking, ramp.duration());
  }
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = *m_members[static_cast<std::size_t>(i)];
    axis.direct.open(axis.task);
    axis.direct.brake(axis.task, shrink * naturalTarget(axis.task), m_braking, axis.task.brakeJerk(axis.task.from));
  }
}

double vpMotionUnit::normNext(const vpMotionFamily *families, double T) noexcept
{
  for (int i = 0; i < m_count; ++i) {
    m_families[static_cast<std::size_t>(i)] = families + i;
  }
  return vpMinimumDuration::nextCandidate(m_families.data(), m_count, m_norm, T);
}

double vpMotionUnit::search(Form form, double T) noexcept
{
  int looks = 0;
  for (; looks < vpMinimumDuration::maxIterations; ++looks) {
    double candidate = T;
    for (int i = 0; i < m_count && candidate < infinity; ++i) {
      candidate = std::max(candidate, (m_members[static_cast<std::size_t>(i)]->*form).next(T));
    }
    if (m_hasNorm && candidate == T) {
      const double fixed = (m_members[0]->*form).fixedDuration();
      for (int i = 0; i < m_count; ++i) {
        m_families[static_cast<std::size_t>(i)] = &(m_members[static_cast<std::size_t>(i)]->*form).middle();
      }
      const double next = vpMinimumDuration::nextCandidate(m_families.data(), m_count, m_norm, T - fixed);
      candidate = next == T - fixed ? T : std::max(fixed + next, T * (1. + 4e-16));
    }
    if (candidate == T || candidate == infinity) {
      m_iterations = std::max(m_iterations, looks + 1);
      return candidate;
    }
    T = candidate;
  }
  m_iterations = std::max(m_iterations, looks);
  return infinity; // undecided: another form answers
}

bool vpMotionUnit::isAtGoal(bool atRest) const noexcept
{
  for (int i = 0; i < m_count; ++i) {
    const vpAxisTask &task = m_members[static_cast<std::size_t>(i)]->task;
    for (std::size_t k = 0; k < static_cast<std::size_t>(task.order); ++k) {
      if (task.from[k] != task.to[k] || (atRest && k > 0 && task.to[k] != 0.)) {
        return false;
      }
    }
  }
  return true;
}

double vpMotionUnit::next(double T) noexcept
{
  m_form = vpTrajectoryForm::Direct;
  m_used = &vpMotionAxis::direct;
  if (isAtGoal(T > 0.)) {
    m_form = vpTrajectoryForm::Hold;
    return T;
  }
  double best = T > m_own ? infinity : search(m_used, T);
  if (m_allowCruise && T <= m_own) {
    const double cruise = at(0).cruise.next(T);
    if (cruise < best) {
      best = cruise;
      m_form = vpTrajectoryForm::Cruise;
    }
  }
  if (best < infinity) {
    return best;
  }
  const double fallback = searchFallback(T);
  // A single polynomial that is quicker than a hard stop does not wait for anything.
  const double free = T <= m_own ? searchFree(T) : infinity;
  if (free < fallback && (m_used == m_last || free < searchLast(T))) {
    m_form = vpTrajectoryForm::Direct;
    m_used = &vpMotionAxis::free;
    return free;
  }
  return fallback;
}

double vpMotionUnit::searchFree(double T) noexcept
{
  if (!m_freeReady) {
    m_freeReady = true;
    for (int i = 0; i < m_count; ++i) {
      vpMotionAxis &axis = at(i);
      vpAxisTask task = axis.task;
      task.limits.minPosition = axis.freeLow;
      task.limits.maxPosition = axis.freeHigh;
      axis.free = axis.direct;
      axis.free.close(task);
    }
  }
  return search(&vpMotionAxis::free, T);
}

double vpMotionUnit::searchFallback(double T) noexcept
{
  m_form = vpTrajectoryForm::Ramped;
  m_used = &vpMotionAxis::ramped;
  if (!m_rampedReady) {
    buildRamped();
  }
  double best = T > m_own || !at(0).ramped.hasFixedPieces() ? infinity : search(m_used, T);
  m_form = best < infinity ? m_form : vpTrajectoryForm::StopAndGo;
  if (!(best < infinity) && T <= m_own) {
    if (!m_softReady) {
      buildSoft();
    }
    m_used = &vpMotionAxis::soft;
    best = search(m_used, T);
  }
  if (!(best < infinity)) {
    best = searchLast(T);
    m_used = m_last;
  }
  return best;
}

double vpMotionUnit::searchLast(double T) noexcept
{
  if (!m_lastBuilt) {
    buildLast();
  }
  if (!m_lastReady) {
    close(m_last);
    m_lastReady = true;
  }
  return search(m_last, T);
}

void vpMotionUnit::buildRamped() noexcept
{
  m_rampedReady = true;
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    axis.ramped = axis.direct;
    axis.ramped.rampHead(m_headRamp);
    axis.ramped.rampTail(m_tailRamp);
  }
  close(&vpMotionAxis::ramped);
}

// A smooth stop, from the ramped form.
void vpMotionUnit::buildSoft() noexcept
{
  m_softReady = true;
  if (!m_rampedReady) {
    buildRamped();
  }
  const double stopHead = commonStop(true), stopTail = commonStop(false);
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    axis.soft = axis.ramped;
    axis.soft.stopHead(stopHead);
    axis.soft.stopTail(stopTail);
  }
  close(&vpMotionAxis::soft);
}

namespace
{
// The task with the acceleration that it may brake with.
vpAxisTask harder(vpAxisTask task, double share, double normAcceleration, double hardness)
{
  double &a = task.limits.acceleration;
  a = std::isfinite(a) ? a : task.brakeAcceleration() * std::sqrt(hardness);
  a = std::isfinite(normAcceleration) ? std::min(a, share * normAcceleration) : a;
  return task;
}

double hardJerk(const vpAxisTask &task, const vpAxisState &x, double hardness)
{
  return std::min(task.limits.jerk, hardness * task.brakeJerk(x));
}
} // namespace

// Members of a norm first lose their acceleration, then they slow down with accelerations in proportion to their
// velocities, so that the norms keep their limits.
void vpMotionUnit::buildHard(double hardness) noexcept
{
  double head2 = 0., tail2 = 0., shortest[2] = {0., 0.};
  for (int i = 0; i < m_count; ++i) {
    const vpAxisTask &task = at(i).task;
    shortest[0] = std::max(shortest[0], std::abs(task.from[2]) / task.limits.jerk);
    shortest[1] = std::max(shortest[1], std::abs(task.to[2]) / task.limits.jerk);
  }
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    axis.hard.open(axis.task);
    if (!isSingle()) {
      axis.hard = axis.direct; // with its braking
      axis.hard.rampHead(m_headRamp > 0. ? std::max(m_headRamp / hardness, shortest[0]) : 0.);
      axis.hard.rampTail(m_tailRamp > 0. ? std::max(m_tailRamp / hardness, shortest[1]) : 0.);
    }
    head2 += axis.hard.head()[1] * axis.hard.head()[1];
    tail2 += axis.hard.tail()[1] * axis.hard.tail()[1];
  }
  const double norm = m_hasNorm ? m_norm.acceleration : infinity;
  double head = 0., tail = 0.;
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    const vpAxisState from = axis.hard.head(), to = axis.hard.tail();
    const double headShare = from[1] != 0. ? std::abs(from[1]) / std::sqrt(head2) : 1.;
    const double tailShare = to[1] != 0. ? std::abs(to[1]) / std::sqrt(tail2) : 1.;
    const vpAxisTask stop = harder(axis.task, headShare, norm, hardness);
    const vpAxisTask start = harder(axis.task, tailShare, norm, hardness);
    axis.hard.brake(stop, 0., 0., hardJerk(stop, from, hardness));
    axis.hard.launch(start, hardJerk(start, {to[0], -to[1], to[2], 0.}, hardness));
    head = std::max(head, axis.hard.headDuration());
    tail = std::max(tail, axis.hard.tailDuration());
  }
  for (int i = 0; i < m_count && !isSingle(); ++i) {
    at(i).hard.padHead(head);
    at(i).hard.padTail(tail);
  }
}

// What always has an answer. It keeps the position limits if it can be hard enough; where the jerk is not limited, up to
// ten thousand times harder than usual, which is within 1e-4 of what no jerk could better.
void vpMotionUnit::buildLast() noexcept
{
  constexpr double hardest = 1e4;
  m_lastBuilt = true;
  m_last = &vpMotionAxis::soft;
  if (order() == 4) {
    buildSoft();
  }
  if (order() != 4 || !keepsPositions(m_last)) {
    m_last = &vpMotionAxis::hard;
    double hardness = 1.;
    buildHard(hardness);
    while (hardness < hardest && !keepsPositions(m_last)) {
      hardness *= 10.;
      buildHard(hardness);
    }
  }
  if (isOutside()) {
    comeBack();
  }
}

// From where the last resort comes to rest to the nearest place inside.
void vpMotionUnit::comeBack() noexcept
{
  const auto inside = [](const vpMotionAxis &axis, double place) {
    return std::clamp(place, axis.task.minPosition, axis.task.maxPosition);
  };
  double T = 0.;
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    const vpAxisState x = (axis.*m_last).head(), goal{inside(axis, x[0]), 0., 0., 0.};
    vpMotionFamily &way = m_steps[static_cast<std::size_t>(i)];
    way = vpMotionFamily::pointToPoint(x, goal, axis.task.order);
    const vpAxisLimits limits = axis.task.withoutPosition();
    T = x[0] == goal[0]
            ? T
            : std::max(T, vpMinimumDuration::solve(way, limits, vpMinimumDuration::lowerBound(x, goal, limits)).T);
  }
  T = commonDuration(T);
  for (int i = 0; i < m_count && T > 0.; ++i) {
    (at(i).*m_last).go(inside(at(i), (at(i).*m_last).head()[0]), T);
  }
}

// The smallest duration >= T for which the motions in m_steps keep the norm.
double vpMotionUnit::commonDuration(double T) noexcept
{
  for (int k = 0; m_hasNorm && T > 0. && k < vpMinimumDuration::maxIterations; ++k) {
    const double next = normNext(m_steps.data(), T);
    if (next == T || next == infinity) {
      break;
    }
    T = next;
  }
  return T;
}

// Members of a norm share their ramps, shortened until the norm keeps its limit at the end of the ramp.
double vpMotionUnit::commonRamp(bool head) noexcept
{
  double common = infinity, shortest = 0.;
  bool any = false;
  for (int i = 0; i < m_count; ++i) {
    const vpMotionAxis &axis = at(i);
    // At the tail, time runs backwards: velocities and jerks change sign.
    const vpAxisState &tail = axis.direct.tail();
    const vpAxisState x = head ? axis.direct.head() : vpAxisState{tail[0], -tail[1], tail[2], -tail[3]};
    const double r = rampDuration(x, axis.task);
    if (r != 0.) {
      common = std::min(common, r);
      shortest = std::max(shortest, axis.task.order == 3 ? std::abs(x[2]) / axis.task.limits.jerk : 0.);
      any = true;
    }
    if (m_hasNorm) {
      m_steps[static_cast<std::size_t>(i)] =
          vpMotionFamily::accelerationStep(x, {x[0], x[1], 0., 0.}, std::max(axis.task.order - 2, 1));
    }
  }
  if (!any) {
    return 0.;
  }
  for (int k = 0; m_hasNorm && k < 40 && common > 0.; ++k) {
    if (normNext(m_steps.data(), common) == common) {
      break;
    }
    common = k < 39 ? 0.5 * common : -1.;
  }
  return common < shortest * (1. - 1e-9) ? -1. : common;
}

double vpMotionUnit::commonStop(bool head) noexcept
{
  double T = 0.;
  for (int i = 0; i < m_count; ++i) {
    const vpMotionAxis &axis = at(i);
    const vpAxisState x = head ? axis.ramped.head() : axis.ramped.tail();
    const vpAxisState rest{x[0], 0., 0., 0.};
    m_steps[static_cast<std::size_t>(i)] = head ? vpMotionFamily::velocityStep(x, rest, axis.task.order - 1)
                                                : vpMotionFamily::velocityStep(rest, x, axis.task.order - 1);
    if (x[1] == 0.) {
      continue;
    }
    vpAxisLimits limits = axis.task.withoutPosition();
    limits.jerk = axis.task.brakeJerk(x); // a short stop is no harder than a long one
    const double lower =
        std::isfinite(limits.acceleration) ? vpMinimumDuration::lowerBound(x, rest, limits) : axis.task.rampUnit();
    T = std::max(T, vpMinimumDuration::solve(m_steps[static_cast<std::size_t>(i)], limits, lower).T);
  }
  return commonDuration(T);
}

void vpMotionUnit::emit(vpTrajectoryPlan &plan, int member, int axis, double factor, double T) const noexcept
{
  const vpMotionAxis &m = at(member);
  if (m_form == vpTrajectoryForm::Cruise) {
    m.direct.emitHead(plan, axis, factor);
    m.cruise.emit(plan, axis, factor, T);
  }
  else {
    (m.*m_used).emit(plan, axis, factor, T);
  }
}

END_VISP_NAMESPACE
