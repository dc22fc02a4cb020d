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
  m_allowCruise = allowCruise && m_count == 1;
  m_droppedPosition = m_droppedGoal = false;
  m_iterations = 0;
  m_braking = 0.;
  bool outside = m_hasNorm && breaksNorm();
  for (int i = 0; i < m_count; ++i) {
    outside = outside || needsBraking(m_members[static_cast<std::size_t>(i)]->task);
  }
  if (outside) {
    brake();
  }
  buildDirect();
}

// The forms that start in the present head of `direct`.
void vpMotionUnit::buildDirect() noexcept
{
  m_fallbackReady = m_stoppingReady = false;
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = *m_members[static_cast<std::size_t>(i)];
    if (m_braking == 0.) {
      axis.direct.open(axis.task);
    }
    axis.direct.close(axis.task);
    if (m_allowCruise) {
      axis.cruise.open(axis.task, axis.direct);
    }
  }
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
    const double end = task.from[1] + a * std::abs(a) / (2. * task.brakeJerk());
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
                              task.brakeAcceleration(), task.brakeJerk());
    m_braking = std::max(m_braking, ramp.duration());
  }
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = *m_members[static_cast<std::size_t>(i)];
    axis.direct.open(axis.task);
    axis.direct.brake(axis.task, shrink * naturalTarget(axis.task), m_braking, axis.task.brakeJerk());
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

double vpMotionUnit::cruiseNext(double T) const noexcept
{
  return m_count == 1 && !m_hasNorm ? m_members[0]->cruise.next(T) : infinity;
}

double vpMotionUnit::next(double T) noexcept
{
  m_form = vpTrajectoryForm::Direct;
  if (isAtGoal(T > 0.)) {
    m_form = vpTrajectoryForm::Hold;
    return T;
  }
  double best = search(&vpMotionAxis::direct, T);
  if (m_allowCruise) {
    const double cruise = cruiseNext(T);
    if (cruise < best) {
      best = cruise;
      m_form = vpTrajectoryForm::Cruise;
    }
  }
  return best < infinity ? best : fallbackNext(T);
}

double vpMotionUnit::fallbackNext(double T) noexcept
{
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (!m_fallbackReady) {
      buildFallback();
    }
    double best = search(&vpMotionAxis::ramped, T);
    m_form = vpTrajectoryForm::Ramped;
    const double cruise = cruiseNext(T);
    if (cruise < best) {
      best = cruise;
      m_form = vpTrajectoryForm::Cruise;
    }
    if (!(best < infinity)) {
      best = stoppingNext(T);
      m_form = vpTrajectoryForm::StopAndGo;
    }
    if (best < infinity) {
      return best;
    }
    // Only position limits can be in the way now: even stopping at once leaves them.
    m_droppedPosition = true;
    for (int i = 0; i < m_count; ++i) {
      vpAxisTask &task = m_members[static_cast<std::size_t>(i)]->task;
      task.limits = task.withoutPosition();
    }
    buildDirect();
  }
  return infinity;
}

double vpMotionUnit::stoppingNext(double T) noexcept
{
  if (!m_stoppingReady) {
    buildStopping();
  }
  return m_stoppingUsable ? search(&vpMotionAxis::stopping, T) : infinity;
}

void vpMotionUnit::buildFallback() noexcept
{
  m_fallbackReady = true;
  double head = commonRamp(true), tail = commonRamp(false);
  if (head < 0. && m_braking == 0.) {
    brake();
    buildDirect();
    m_fallbackReady = true;
    head = 0.; // braking ends with zero acceleration
  }
  if (tail < 0.) {
    m_droppedGoal = true;
    tail = 0.;
    for (int i = 0; i < m_count; ++i) {
      vpAxisTask &task = m_members[static_cast<std::size_t>(i)]->task;
      task.to[2] = task.to[3] = 0.;
    }
    if (m_braking > 0.) {
      brake();
    }
    buildDirect();
    m_fallbackReady = true;
  }
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = *m_members[static_cast<std::size_t>(i)];
    axis.ramped = axis.direct;
    axis.ramped.rampHead(head);
    axis.ramped.rampTail(tail);
    axis.ramped.close(axis.task);
    if (m_count == 1 && !m_hasNorm) {
      axis.cruise.open(axis.task, axis.direct);
    }
  }
}

// From the ramped form.
void vpMotionUnit::buildStopping() noexcept
{
  m_stoppingReady = true;
  const double stopHead = commonStop(true), stopTail = commonStop(false);
  m_stoppingUsable = true;
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = *m_members[static_cast<std::size_t>(i)];
    axis.stopping = axis.ramped;
    axis.stopping.stopHead(stopHead);
    axis.stopping.stopTail(stopTail);
    axis.stopping.close(axis.task);
    m_stoppingUsable = m_stoppingUsable && axis.stopping.fixedKeepPosition(axis.task.limits);
  }
  if (!m_stoppingUsable && m_count == 1 && !m_hasNorm) {
    stopHard();
  }
}

// When the smooth stop is too long for the position limits: stop and launch as hard as the other limits allow, with more
// jerk than elsewhere where the jerk is free.
void vpMotionUnit::stopHard() noexcept
{
  vpMotionAxis &axis = *m_members[0];
  double jerk = axis.task.brakeJerk();
  for (int k = 0; k < 4 && !m_stoppingUsable; ++k, jerk = std::min(10. * jerk, axis.task.limits.jerk)) {
    axis.stopping = axis.direct;
    if (m_braking == 0.) {
      axis.stopping.brake(axis.task, 0., 0., jerk);
    }
    else {
      axis.stopping.stopHead(commonStop(true));
    }
    axis.stopping.launch(axis.task, jerk);
    axis.stopping.close(axis.task);
    m_stoppingUsable = axis.stopping.fixedKeepPosition(axis.task.limits);
  }
}

// Members of a norm share their ramps, shortened until the norm keeps its limit at the end of the ramp.
double vpMotionUnit::commonRamp(bool head) noexcept
{
  double common = infinity;
  bool any = false;
  for (int i = 0; i < m_count; ++i) {
    const vpMotionAxis &axis = *m_members[static_cast<std::size_t>(i)];
    // At the tail, time runs backwards: velocities and jerks change sign.
    const vpAxisState &tail = axis.direct.tail();
    const vpAxisState x = head ? axis.direct.head() : vpAxisState{tail[0], -tail[1], tail[2], -tail[3]};
    const double r = rampDuration(x, axis.task);
    if (r != 0.) {
      common = std::min(common, r);
      any = true;
    }
    m_steps[static_cast<std::size_t>(i)] =
        vpMotionFamily::accelerationStep(x, {x[0], x[1], 0., 0.}, std::max(axis.task.order - 2, 1));
  }
  if (!any) {
    return 0.;
  }
  for (int k = 0; m_hasNorm && k < 40 && common > 0.; ++k) {
    if (normNext(m_steps.data(), common) == common) {
      return common;
    }
    common *= 0.5;
  }
  return m_hasNorm ? -1. : common;
}

double vpMotionUnit::commonStop(bool head) noexcept
{
  double T = 0.;
  for (int i = 0; i < m_count; ++i) {
    const vpMotionAxis &axis = *m_members[static_cast<std::size_t>(i)];
    const vpAxisState x = head ? axis.ramped.head() : axis.ramped.tail();
    const vpAxisState rest{x[0], 0., 0., 0.};
    m_steps[static_cast<std::size_t>(i)] = head ? vpMotionFamily::velocityStep(x, rest, axis.task.order - 1)
                                                : vpMotionFamily::velocityStep(rest, x, axis.task.order - 1);
    if (x[1] == 0.) {
      continue;
    }
    const vpAxisLimits limits = axis.task.withoutPosition();
    const double lower =
        std::isfinite(limits.acceleration) ? vpMinimumDuration::lowerBound(x, rest, limits) : axis.task.rampUnit();
    T = std::max(T, vpMinimumDuration::solve(m_steps[static_cast<std::size_t>(i)], limits, lower).T);
  }
  for (int k = 0; m_hasNorm && T > 0. && k < vpMinimumDuration::maxIterations; ++k) {
    const double next = normNext(m_steps.data(), T);
    if (next == T || next == infinity) {
      break;
    }
    T = next;
  }
  return T;
}

void vpMotionUnit::emit(vpTrajectoryPlan &plan, int member, int axis, double factor, double T) const noexcept
{
  const vpMotionAxis &m = *m_members[static_cast<std::size_t>(member)];
  switch (m_form) {
  case vpTrajectoryForm::Cruise:
    m.direct.emitHead(plan, axis, factor);
    return m.cruise.emit(plan, axis, factor, T);
  case vpTrajectoryForm::Ramped:
    return m.ramped.emit(plan, axis, factor, T);
  case vpTrajectoryForm::StopAndGo:
    return m.stopping.emit(plan, axis, factor, T);
  default:
    return m.direct.emit(plan, axis, factor, T);
  }
}

END_VISP_NAMESPACE
