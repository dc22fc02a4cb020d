/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpAxisForms.h"

#include "vpRootKernel.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

void append(vpTrajectoryPlan &plan, int axis, const vpPolynomial &p, double factor, double duration)
{
  if (factor == 1.) {
    plan.append(axis, p, duration);
    return;
  }
  vpPolynomial scaled = p;
  for (int k = 0; k <= p.degree(); ++k) {
    scaled[k] *= factor;
  }
  plan.append(axis, scaled, duration);
}

bool isBounded(const vpAxisLimits &limits)
{
  return std::isfinite(limits.minPosition) || std::isfinite(limits.maxPosition);
}
} // namespace

void vpFramedMotion::open(const vpAxisTask &task) noexcept
{
  m_heads = m_tails = 0;
  m_headTime = m_tailTime = 0.;
  m_hullKnown = false;
  m_order = task.order;
  m_head = task.from;
  m_tail = task.to;
}

void vpFramedMotion::addHead(const vpPolynomial &p, double duration) noexcept
{
  m_headPieces[static_cast<std::size_t>(m_heads++)] = {p, duration};
  m_headTime += duration;
  m_hullKnown = false;
}

void vpFramedMotion::addTail(const vpPolynomial &p, double duration) noexcept
{
  m_tailPieces[static_cast<std::size_t>(m_tails++)] = {p, duration};
  m_tailTime += duration;
  m_hullKnown = false;
}

void vpFramedMotion::rampTo(double target, double acceleration, double jerk) noexcept
{
  vpAxisState x{m_head[0], m_head[1], m_order > 2 ? m_head[2] : 0., 0.};
  if (m_order == 2) { // the acceleration may jump
    const double t = std::abs(target - x[1]) / acceleration;
    if (t > 0.) {
      addHead({0., x[1] * t, 0.5 * (target - x[1]) * t}, t);
      x[0] += 0.5 * (x[1] + target) * t;
    }
  }
  else {
    const vpVelocityRamp ramp(x[1], x[2], target, acceleration, jerk);
    for (int i = 0; i < ramp.count(); ++i) {
      const auto &piece = ramp.piece(i);
      const double d = piece.duration;
      addHead({0., x[1] * d, x[2] * d * d / 2., piece.jerk * d * d * d / 6.}, d);
      x[0] += d * (x[1] + d * (x[2] / 2. + d * piece.jerk / 6.));
      x[1] += d * (x[2] + d * piece.jerk / 2.);
      x[2] += d * piece.jerk;
    }
  }
  m_head = {x[0], target, 0., 0.};
}

void vpFramedMotion::brake(const vpAxisTask &task, double target, double duration, double jerk) noexcept
{
  const double before = m_headTime;
  rampTo(target, task.brakeAcceleration(), jerk);
  const double rest = duration - (m_headTime - before);
  if (rest > 0.) {
    addHead({0., target * rest}, rest);
    m_head[0] += target * rest;
  }
}

void vpFramedMotion::brake(const vpHardStop &stop) noexcept
{
  for (int i = 0; i < stop.count; ++i) {
    rampTo(stop.velocities[static_cast<std::size_t>(i)], stop.acceleration, stop.jerk);
  }
}

void vpFramedMotion::go(double place, double duration) noexcept
{
  const vpAxisState goal{place, 0., 0., 0.};
  addHead(vpMotionFamily::pointToPoint(m_head, goal, m_order).at(duration), duration);
  m_head = goal;
}

void vpFramedMotion::padHead(double duration) noexcept
{
  if (duration > m_headTime) {
    addHead({}, duration - m_headTime);
  }
}

void vpFramedMotion::padTail(double duration) noexcept
{
  if (duration > m_tailTime) {
    addTail({}, duration - m_tailTime);
  }
}

void vpFramedMotion::launch(const vpAxisTask &task, double jerk) noexcept
{
  if (isTailAtRest()) {
    m_tail = {m_tail[0], 0., 0., 0.};
    return;
  }
  vpFramedMotion backwards;
  backwards.m_order = m_order;
  backwards.m_head = m_tail;
  backwards.m_head[1] = -m_tail[1];
  backwards.brake(task, 0., 0., jerk);
  takeTail(backwards);
}

void vpFramedMotion::launch(const vpHardStop &stop) noexcept
{
  if (isTailAtRest()) {
    m_tail = {m_tail[0], 0., 0., 0.};
    return;
  }
  vpFramedMotion backwards;
  backwards.m_order = m_order;
  backwards.m_head = m_tail;
  backwards.m_head[1] = -m_tail[1];
  backwards.brake(stop);
  takeTail(backwards);
}

// Time runs backwards from the goal.
void vpFramedMotion::takeTail(const vpFramedMotion &backwards) noexcept
{
  for (int i = 0; i < backwards.m_heads; ++i) {
    const Piece &piece = backwards.m_headPieces[static_cast<std::size_t>(i)];
    vpPolynomial p = piece.p.composed(1., -1.);
    p[0] = 0.;
    addTail(p, piece.duration);
  }
  m_tail = backwards.m_head;
}

void vpFramedMotion::rampHead(double r) noexcept
{
  if (!(r > 0.)) {
    return;
  }
  const vpPolynomial p = vpMotionFamily::accelerationStep(m_head, {m_head[0], m_head[1], 0., 0.}, m_order - 2).at(r);
  const auto end = p.jet(1.);
  addHead(p, r);
  m_head = {m_head[0] + end[0], end[1] / r, 0., 0.};
}

void vpFramedMotion::rampTail(double r) noexcept
{
  if (!(r > 0.)) {
    return;
  }
  const double j = m_order == 4 ? m_tail[3] : 0.;
  const double v = m_tail[1] - r * (m_tail[2] / 2. - r * j / 12.);
  const vpPolynomial p = vpMotionFamily::accelerationStep({0., v, 0., 0.}, m_tail, m_order - 2).at(r);
  addTail(p, r);
  m_tail = {m_tail[0] - p.value(1.), v, 0., 0.};
}

void vpFramedMotion::stopHead(double T) noexcept
{
  if (m_head[1] == 0. || !(T > 0.)) {
    return;
  }
  const vpPolynomial p = vpMotionFamily::velocityStep(m_head, {}, m_order - 1).at(T);
  addHead(p, T);
  m_head = {m_head[0] + p.value(1.), 0., 0., 0.};
}

void vpFramedMotion::stopTail(double T) noexcept
{
  if (m_tail[1] == 0. || !(T > 0.)) {
    return;
  }
  const vpPolynomial p = vpMotionFamily::velocityStep({}, m_tail, m_order - 1).at(T);
  addTail(p, T);
  m_tail = {m_tail[0] - p.value(1.), 0., 0., 0.};
}

void vpFramedMotion::close(const vpAxisTask &task) noexcept
{
  m_middle = vpMotionFamily::pointToPoint(m_head, m_tail, m_order);
  m_middleLimits = task.limits;
  m_middleLimits.minPosition -= m_head[0];
  m_middleLimits.maxPosition -= m_head[0];
  m_blocked = false;
  if (hasFixedPieces() && isBounded(task.limits)) {
    double low = 0., high = 0.;
    hull(low, high);
    const double slack = vpMinimumDuration::tolerance * (high - low);
    m_blocked = !(low >= task.limits.minPosition - slack && high <= task.limits.maxPosition + slack);
  }
  if (m_blocked) {
    return;
  }
  const auto rests = [](const vpAxisState &x) { return x[1] == 0. && x[2] == 0.; };
  m_restToRest = m_order == 3 && rests(m_head) && rests(m_tail);
  const double lower = vpMinimumDuration::lowerBound(m_head, m_tail, m_middleLimits);
  m_lower = m_restToRest ? std::max(lower, restToRestDuration())
                         : vpMinimumDuration::raiseLowerBound(m_middle, m_middleLimits, lower);
}

// The smallest of the quintic, whose peaks are 15/8 h/T, 10/sqrt(3) h/T^2 and 60 h/T^3.
double vpFramedMotion::restToRestDuration() const noexcept
{
  const double h = std::abs(m_tail[0] - m_head[0]);
  return std::max({1.875 * h / m_middleLimits.velocity, std::sqrt(5.773502691896258 * h / m_middleLimits.acceleration),
                   std::cbrt(60. * h / m_middleLimits.jerk)});
}

void vpFramedMotion::hull(double &low, double &high) const noexcept
{
  if (!m_hullKnown) {
    m_low = m_high = 0.;
    double place = 0.;
    const auto include = [&](const vpPolynomial &p) {
      double min = 0., max = 0.;
      vpRootKernel::extremes(p.data(), p.degree(), 0., min, max);
      m_low = std::min(m_low, place + min);
      m_high = std::max(m_high, place + max);
      place += p.value(1.);
    };
    for (int i = 0; i < m_heads; ++i) {
      include(m_headPieces[static_cast<std::size_t>(i)].p);
    }
    place = m_tail[0];
    include(vpPolynomial{});
    for (int i = m_tails; i > 0; --i) {
      include(m_tailPieces[static_cast<std::size_t>(i - 1)].p);
    }
    m_hullKnown = true;
  }
  low = m_low;
  high = m_high;
}

bool vpFramedMotion::fixedStaysWithin(double low, double high) const noexcept
{
  if (!hasFixedPieces()) {
    return true;
  }
  double a = 0., b = 0.;
  hull(a, b);
  return a >= low && b <= high;
}

bool vpFramedMotion::staysWithin(double low, double high, double T) const noexcept
{
  if (!fixedStaysWithin(low, high)) {
    return false;
  }
  if (m_restToRest) {
    return std::min(m_head[0], m_tail[0]) >= low && std::max(m_head[0], m_tail[0]) <= high;
  }
  double c[vpMotionFamily::maxDegree + 1];
  m_middle.evaluate(T - fixedDuration(), c);
  c[0] += m_head[0];
  return vpRootKernel::staysWithin(c, m_middle.degree(), low, high);
}

double vpFramedMotion::next(double T) const noexcept
{
  if (m_blocked) {
    return infinity;
  }
  const double fixed = fixedDuration(), free = T - fixed;
  if (free < m_lower && fixed + m_lower > T) {
    return fixed + m_lower;
  }
  if (m_restToRest) {
    return T;
  }
  const double now = std::max(free, m_lower);
  const double candidate = vpMinimumDuration::nextCandidate(m_middle, m_middleLimits, now);
  return candidate == now ? T : std::max(fixed + candidate, T * (1. + 4e-16));
}

void vpFramedMotion::emitHead(vpTrajectoryPlan &plan, int axis, double factor) const noexcept
{
  for (int i = 0; i < m_heads; ++i) {
    const Piece &piece = m_headPieces[static_cast<std::size_t>(i)];
    append(plan, axis, piece.p, factor, piece.duration);
  }
}

void vpFramedMotion::emit(vpTrajectoryPlan &plan, int axis, double factor, double T) const noexcept
{
  emitHead(plan, axis, factor);
  const double free = T - fixedDuration();
  append(plan, axis, m_middle.at(free), factor, free);
  for (int i = m_tails; i > 0; --i) {
    const Piece &piece = m_tailPieces[static_cast<std::size_t>(i - 1)];
    append(plan, axis, piece.p, factor, piece.duration);
  }
}

namespace
{
// For a change of velocity d > 0 from the acceleration a >= 0 the least T in which the quartic keeps the limit A is
// 3 d/(a + A + sqrt(A (A - a))), because its greatest acceleration is (3 d - a T)^2/(3 (2 d - a T) T); its jerk is linear,
// from (6 d - 4 a T)/T^2 to (2 a T - 6 d)/T^2.
double leastVelocityStep(double d, double a, const vpAxisLimits &limits)
{
  const double A = limits.acceleration, J = limits.jerk;
  double T = 3. * d / (a + A + std::sqrt(A * (A - a)));
  constexpr int rounds = 8; // each goes to the next root of one end; rounding could go on for ever
  bool raised = std::isfinite(J);
  for (int k = 0; k < rounds && raised; ++k) {
    raised = false;
    for (const double share : {4., 2.}) {
      const double y = 6. * d - share * a * T, excess = std::abs(y) - J * T * T;
      if (excess > vpMinimumDuration::tolerance * J * T * T) {
        const double g[] = {excess, -std::copysign(share * a, y) - 2. * J * T, -J};
        T = std::max(T + vpRootKernel::firstPositiveRoot(g, 2), T * (1. + 4e-16));
        raised = true;
      }
    }
  }
  return T;
}

// Smallest duration of the quartic from (v, a) to (target, 0); infinite where there is none.
double velocityStepDuration(double v, double a, double target, const vpAxisLimits &limits)
{
  const vpAxisState from{0., v, a, 0.}, to{0., target, 0., 0.};
  const vpMotionFamily step = vpMotionFamily::velocityStep(from, to, 2);
  double T = vpMinimumDuration::lowerBound(from, to, limits);
  const double side = target < v ? -1. : 1., d = side * (target - v);
  if (d > 0. && side * a <= limits.acceleration) {
    T = std::max(T, leastVelocityStep(d, side * a, limits));
    if (a == 0. || (side * a > 0. && side * a * T <= 3. * d)) { // the velocity is monotone
      return T;
    }
  }
  const vpDurationAnswer answer = vpMinimumDuration::solve(step, limits, T);
  return answer.kind == vpDurationAnswer::Kind::Found ? answer.T : infinity;
}
} // namespace

void vpCruiseMotion::open(const vpAxisTask &task, const vpFramedMotion &framed) noexcept
{
  m_available = false;
  const vpAxisState &from = framed.head(), &to = framed.tail();
  const double h = to[0] - from[0];
  if (framed.isBlocked() || task.order != 3 || h == 0. || !std::isfinite(task.limits.velocity) ||
      !std::isfinite(task.limits.acceleration)) {
    return;
  }
  const double full = std::copysign(task.limits.velocity, h);
  const vpAxisLimits free = task.withoutPosition();
  // With time running backwards the acceleration changes sign.
  const double up = velocityStepDuration(from[1], from[2], full, free);
  const double down = velocityStepDuration(to[1], -to[2], full, free);
  if (up < infinity && down < infinity) {
    open(task, framed, up, down, framed.fixedDuration() + rest(framed, up, down) / full + 0.5 * (up + down));
  }
}

void vpCruiseMotion::open(const vpAxisTask &task, const vpFramedMotion &framed, double up, double down,
                          double shortest) noexcept
{
  m_from = framed.head();
  m_to = framed.tail();
  m_braked = framed.fixedDuration();
  m_limits = task.limits;
  m_up = up;
  m_down = down;
  m_shortest = shortest;
  m_rest = rest(framed, up, down);
  m_available = shortest < infinity && shortest >= m_braked + up + down;
}

double vpCruiseMotion::least(double fixed, double h, double v0, double v1, double v, double a) noexcept
{
  const double side = std::copysign(1., h);
  if (h == 0. || !std::isfinite(v) || !std::isfinite(a)) {
    return infinity;
  }
  v0 *= side;
  v1 *= side;
  const double constant = side * h - (2. * v * v - v0 * v0 - v1 * v1) / (2. * a);
  return constant >= 0. ? fixed + (2. * v - v0 - v1) / a + constant / v : infinity;
}

void vpCruiseMotion::ramps(double T, vpMotionFamily &up, vpMotionFamily &down) const noexcept
{
  const vpAxisState cruise{0., cruiseAt(T), 0., 0.};
  up = vpMotionFamily::velocityStep(m_from, cruise, 2);
  down = vpMotionFamily::velocityStep(cruise, m_to, 2);
}

// The ramps' lengths are linear in the velocity between them.
double vpCruiseMotion::rest(const vpFramedMotion &framed, double up, double down) noexcept
{
  const vpAxisState &from = framed.head(), &to = framed.tail();
  return to[0] - from[0] - up * (from[1] / 2. + up * from[2] / 12.) - down * (to[1] / 2. - down * to[2] / 12.);
}

// The velocity that takes the duration T with the same ramps.
double vpCruiseMotion::cruiseAt(double T) const noexcept { return m_rest / (T - m_braked - 0.5 * (m_up + m_down)); }

double vpCruiseMotion::next(double T) const noexcept
{
  if (!m_available) {
    return infinity;
  }
  T = std::max(T, m_shortest);
  vpMotionFamily up, down;
  ramps(T, up, down);
  vpAxisLimits free = m_limits;
  free.minPosition = -infinity;
  free.maxPosition = infinity;
  const bool keeps = std::abs(cruiseAt(T)) <= m_limits.velocity * (1. + vpMinimumDuration::tolerance) &&
                     vpMinimumDuration::isFeasible(up, free, m_up) &&
                     vpMinimumDuration::isFeasible(down, free, m_down) &&
                     (!isBounded(m_limits) || staysWithin(m_limits.minPosition, m_limits.maxPosition, T));
  return keeps ? T : infinity;
}

bool vpCruiseMotion::staysWithin(double low, double high, double T) const noexcept
{
  vpMotionFamily up, down;
  ramps(T, up, down);
  const auto within = [=](const vpMotionFamily &ramp, double duration, const vpAxisState &end, double share) {
    double c[vpMotionFamily::maxDegree + 1], way = 0., size = std::abs(end[0]);
    ramp.evaluate(duration, c);
    for (int k = 1; k <= ramp.degree(); ++k) {
      way += c[k];
      size += std::abs(c[k]);
    }
    c[0] = end[0] - share * way;
    const double slack = vpMinimumDuration::tolerance * size;
    return vpRootKernel::staysWithin(c, ramp.degree(), low - slack, high + slack);
  };
  return within(up, m_up, m_from, 0.) && within(down, m_down, m_to, 1.);
}

void vpCruiseMotion::emit(vpTrajectoryPlan &plan, int axis, double factor, double T) const noexcept
{
  vpMotionFamily up, down;
  ramps(T, up, down);
  const double constant = T - m_braked - m_up - m_down;
  append(plan, axis, up.at(m_up), factor, m_up);
  plan.append(axis, {0., factor * cruiseAt(T) * constant}, constant);
  append(plan, axis, down.at(m_down), factor, m_down);
}

END_VISP_NAMESPACE
