/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// How the members of a unit ramp, brake, stop and launch together.
#include "vpCoupledAxes.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
} // namespace

void vpCoupledAxes::dropGoalAcceleration() noexcept
{
  m_droppedGoal = true;
  m_tailRamp = 0.;
  for (int i = 0; i < m_count; ++i) {
    vpAxisTask &task = at(i).task;
    task.to[2] = task.to[3] = 0.;
    at(i)[vpMotionAxis::Direct].open(task);
  }
}

// All members return inside together: their velocities keep their ratios.
void vpCoupledAxes::brake() noexcept
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
    axis[vpMotionAxis::Direct].open(axis.task);
    axis[vpMotionAxis::Direct].brake(axis.task, shrink * naturalTarget(axis.task), m_braking,
                                     axis.task.brakeJerk(axis.task.from));
  }
}

double vpCoupledAxes::normNext(const vpMotionFamily *families, double T) noexcept
{
  for (int i = 0; i < m_count; ++i) {
    m_families[static_cast<std::size_t>(i)] = families + i;
  }
  return vpMinimumDuration::nextCandidate(m_families.data(), m_count, m_norm, T);
}

void vpCoupledAxes::buildRamped() noexcept
{
  m_rampedReady = true;
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    axis[vpMotionAxis::Ramped] = axis[vpMotionAxis::Direct];
    axis[vpMotionAxis::Ramped].rampHead(m_headRamp);
    axis[vpMotionAxis::Ramped].rampTail(m_tailRamp);
  }
  close(vpMotionAxis::Ramped);
}

void vpCoupledAxes::buildSoft() noexcept
{
  constexpr double gentle = 0.25; // a quarter of the usual jerk, about that of a smooth polynomial
  if (order() == 4) {
    buildSmooth();
  }
  else {
    buildStop(vpMotionAxis::Soft, gentle);
  }
  m_softReady = true;
  bool roomy = true;
  for (int i = 0; i < m_count; ++i) {
    roomy = roomy && at(i)[vpMotionAxis::Soft].fixedStaysWithin(at(i).low, at(i).high);
  }
  if (roomy || order() == 4) { // where it may be the fallback
    close(vpMotionAxis::Soft);
  }
  else {
    m_none[vpMotionAxis::Soft] = 0.;
  }
}

// A stop with continuous jerk, from the ramped form.
void vpCoupledAxes::buildSmooth() noexcept
{
  if (!m_rampedReady) {
    buildRamped();
  }
  const double stopHead = commonStop(true), stopTail = commonStop(false);
  for (int i = 0; i < m_count; ++i) {
    vpFramedMotion &soft = at(i)[vpMotionAxis::Soft];
    soft = at(i)[vpMotionAxis::Ramped];
    soft.stopHead(stopHead);
    soft.stopTail(stopTail);
  }
}

// Members of a norm first lose their acceleration, then they slow down with accelerations in proportion to their
// velocities, so that the norms keep their limits.
void vpCoupledAxes::buildStop(Form form, double hardness) noexcept
{
  double head2 = 0., tail2 = 0., shortest[2] = {0., 0.};
  for (int i = 0; i < m_count; ++i) {
    const vpAxisTask &task = at(i).task;
    shortest[0] = std::max(shortest[0], std::abs(task.from[2]) / task.limits.jerk);
    shortest[1] = std::max(shortest[1], std::abs(task.to[2]) / task.limits.jerk);
  }
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    vpFramedMotion &motion = axis[form];
    motion.open(axis.task);
    if (!isSingle()) {
      motion = axis[vpMotionAxis::Direct]; // including its braking
      motion.rampHead(m_headRamp > 0. ? std::max(m_headRamp / std::max(hardness, 1.), shortest[0]) : 0.);
      motion.rampTail(m_tailRamp > 0. ? std::max(m_tailRamp / std::max(hardness, 1.), shortest[1]) : 0.);
    }
    head2 += motion.head()[1] * motion.head()[1];
    tail2 += motion.tail()[1] * motion.tail()[1];
  }
  const double norm = m_hasNorm ? m_norm.acceleration : infinity;
  double head = 0., tail = 0.;
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    vpFramedMotion &motion = axis[form];
    const vpAxisState from = motion.head(), to = motion.tail();
    const double headShare = from[1] != 0. ? std::abs(from[1]) / std::sqrt(head2) : 1.;
    const double tailShare = to[1] != 0. ? std::abs(to[1]) / std::sqrt(tail2) : 1.;
    vpAxisTask stop = axis.task.harder(hardness), start = stop;
    stop.limits.acceleration = std::min(stop.limits.acceleration, headShare * norm);
    start.limits.acceleration = std::min(start.limits.acceleration, tailShare * norm);
    motion.brake(stop, 0., 0., stop.brakeJerk(from, hardness));
    motion.launch(start, start.brakeJerk({to[0], -to[1], to[2], 0.}, hardness));
    head = std::max(head, motion.headDuration());
    tail = std::max(tail, motion.tailDuration());
  }
  for (int i = 0; i < m_count && !isSingle(); ++i) {
    at(i)[form].padHead(head);
    at(i)[form].padTail(tail);
  }
}

// What always has an answer. It keeps the position limits if it can be hard enough, or exceeds them as little as can be;
// see vpHardStop. Members of a norm brake together, so that there the excess is that of the hardest stop to rest.
void vpCoupledAxes::buildLast() noexcept
{
  constexpr double hardest = 1e4;
  m_lastBuilt = true;
  m_last = vpMotionAxis::Soft;
  if (order() == 4) {
    buildSoft();
  }
  if (order() != 4 || !keepsPositions(m_last)) {
    m_last = vpMotionAxis::Hard;
    if (isSingle()) {
      buildHardStop();
    }
    else {
      double hardness = 1.;
      buildStop(m_last, hardness);
      while (hardness < hardest && !keepsPositions(m_last)) {
        hardness *= 10.;
        buildStop(m_last, hardness);
      }
    }
  }
  if (isOutside()) {
    comeBack();
  }
}

void vpCoupledAxes::buildHardStop() noexcept
{
  const vpAxisTask &task = at(0).task;
  vpFramedMotion &motion = at(0)[m_last];
  motion.open(task);
  const double low = task.lowest(), high = task.highest();
  motion.brake(vpHardStop(task.from, task, low, high));
  const double goal = task.to[0];
  motion.launch(vpHardStop({0., -task.to[1], task.to[2], 0.}, task, low - goal, high - goal));
}

// From where the last resort comes to rest to the nearest place inside.
void vpCoupledAxes::comeBack() noexcept
{
  const auto inside = [](const vpMotionAxis &axis, double place) {
    return std::clamp(place, axis.task.minPosition, axis.task.maxPosition);
  };
  double T = 0.;
  for (int i = 0; i < m_count; ++i) {
    vpMotionAxis &axis = at(i);
    const vpAxisState x = axis[m_last].head(), goal{inside(axis, x[0]), 0., 0., 0.};
    vpMotionFamily &way = m_steps[static_cast<std::size_t>(i)];
    way = vpMotionFamily::pointToPoint(x, goal, axis.task.order);
    const vpAxisLimits limits = axis.task.withoutPosition();
    T = x[0] == goal[0]
            ? T
            : std::max(T, vpMinimumDuration::solve(way, limits, vpMinimumDuration::lowerBound(x, goal, limits)).T);
  }
  T = commonDuration(T);
  for (int i = 0; i < m_count && T > 0.; ++i) {
    at(i)[m_last].go(inside(at(i), at(i)[m_last].head()[0]), T);
  }
}

// The smallest duration >= T for which the motions in m_steps keep the norm.
double vpCoupledAxes::commonDuration(double T) noexcept
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
double vpCoupledAxes::commonRamp(bool head) noexcept
{
  double common = infinity, shortest = 0.;
  bool any = false;
  for (int i = 0; i < m_count; ++i) {
    const vpMotionAxis &axis = at(i);
    // At the tail, time runs backwards: velocities and jerks change sign.
    const vpAxisState &tail = axis[vpMotionAxis::Direct].tail();
    const vpAxisState x = head ? axis[vpMotionAxis::Direct].head() : vpAxisState{tail[0], -tail[1], tail[2], -tail[3]};
    const double r = rampDuration(x, axis.task, axis.task.order);
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

double vpCoupledAxes::commonStop(bool head) noexcept
{
  double T = 0.;
  for (int i = 0; i < m_count; ++i) {
    const vpMotionAxis &axis = at(i);
    const vpAxisState x = head ? axis[vpMotionAxis::Ramped].head() : axis[vpMotionAxis::Ramped].tail();
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

// No cruise is shorter: for a group along its way, with what its ramps do to the direction left out.
double vpCoupledAxes::leastCruise() const noexcept
{
  double h = 0., v0 = 0., v1 = 0., v = m_hasNorm ? m_norm.velocity : infinity, a = infinity;
  for (int i = 0; i < m_count; ++i) {
    const vpFramedMotion &motion = at(i)[vpMotionAxis::Direct];
    h = isSingle() ? motion.tail()[0] - motion.head()[0] : std::hypot(h, motion.tail()[0] - motion.head()[0]);
  }
  for (int i = 0; i < m_count && h != 0.; ++i) {
    const vpFramedMotion &motion = at(i)[vpMotionAxis::Direct];
    const double u = (motion.tail()[0] - motion.head()[0]) / h;
    v0 += u * motion.head()[1];
    v1 += u * motion.tail()[1];
    v = std::min(v, at(i).task.limits.velocity / std::abs(u));
    a = std::min(a, at(i).task.limits.acceleration / std::abs(u));
  }
  a = m_hasNorm ? std::min(a, m_norm.acceleration) : a;
  return vpCruiseMotion::least(at(0)[vpMotionAxis::Direct].fixedDuration(), h, v0, v1, v, a);
}

// Members of a norm share the durations of their ramps. The direction of the constant velocity follows from these, and
// they from it: a few rounds, and ramps a hundredth longer for what the direction still changes.
void vpCoupledAxes::openCruise() noexcept
{
  constexpr int rounds = 3;
  m_cruiseReady = true;
  if (isSingle()) {
    at(0).cruise.open(at(0).task, at(0)[vpMotionAxis::Direct]);
    return;
  }
  double up = 0., down = 0., rest = 0.;
  for (int k = 0; k <= rounds && up < infinity && down < infinity; ++k) {
    if (k > 0) {
      const double first = commonStep(true, rest, up, down), last = commonStep(false, rest, up, down);
      up = first * (k < rounds ? 1. : 1.01);
      down = last * (k < rounds ? 1. : 1.01);
    }
    // What the rest takes at the full speed.
    double norm = 0.;
    rest = 0.;
    for (int i = 0; i < m_count; ++i) {
      const double way = vpCruiseMotion::rest(at(i)[vpMotionAxis::Direct], up, down);
      norm = std::hypot(norm, way);
      rest = std::max(rest, std::abs(way) / at(i).task.limits.velocity);
    }
    rest = m_hasNorm ? std::max(rest, norm / m_norm.velocity) : rest;
  }
  for (int i = 0; i < m_count; ++i) {
    const vpFramedMotion &motion = at(i)[vpMotionAxis::Direct];
    at(i).cruise.open(at(i).task, motion, up, down,
                      motion.isBlocked() ? infinity : motion.fixedDuration() + rest + 0.5 * (up + down));
  }
}

// Smallest common duration of the ramps to, or from, the velocities that take \e rest for what ramps of the durations
// \e up and \e down leave.
double vpCoupledAxes::commonStep(bool head, double rest, double up, double down) noexcept
{
  double T = 0.;
  for (int i = 0; i < m_count; ++i) {
    const vpFramedMotion &motion = at(i)[vpMotionAxis::Direct];
    const vpAxisState cruise{0., vpCruiseMotion::rest(motion, up, down) / rest, 0., 0.};
    const vpAxisState from = head ? motion.head() : cruise, to = head ? cruise : motion.tail();
    m_steps[static_cast<std::size_t>(i)] = vpMotionFamily::velocityStep(from, to, 2);
    T = std::max(T, vpMinimumDuration::lowerBound({0., from[1], from[2], 0.}, {0., to[1], to[2], 0.},
                                                  at(i).task.withoutPosition()));
  }
  for (int k = 0; k < vpMinimumDuration::maxIterations; ++k) {
    double next = normNext(m_steps.data(), T);
    for (int i = 0; i < m_count; ++i) {
      next = std::max(next, vpMinimumDuration::nextCandidate(m_steps[static_cast<std::size_t>(i)],
                                                             at(i).task.withoutPosition(), T));
    }
    if (next == T || !(next < infinity)) {
      return next;
    }
    T = next;
  }
  return infinity;
}

double vpCoupledAxes::searchCruise(double T) noexcept
{
  if (!m_cruiseReady) {
    openCruise();
  }
  for (int i = 0; i < m_count && T < infinity; ++i) {
    T = at(i).cruise.next(T);
  }
  for (const bool head : {true, false}) {
    double duration = 0.;
    for (int i = 0; i < m_count && m_hasNorm && T < infinity; ++i) {
      vpMotionFamily up, down;
      at(i).cruise.ramps(T, up, down);
      m_steps[static_cast<std::size_t>(i)] = head ? up : down;
      duration = head ? at(i).cruise.up() : at(i).cruise.down();
    }
    T = duration > 0. && normNext(m_steps.data(), duration) != duration ? infinity : T;
  }
  return T;
}

END_VISP_NAMESPACE
