/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpAxisForms.h"

#include <visp3/trajectory/vpVelocityRamp.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

vpVelocityRamp::vpVelocityRamp(double v, double a, double target, double maxAcceleration, double maxJerk) noexcept
  : m_v(v), m_a(a), m_target(target)
{
  const double J = maxJerk;
  if (std::abs(a) > maxAcceleration) {
    const double excess = std::abs(a) - maxAcceleration;
    add(excess / J, -std::copysign(J, a));
    v += std::copysign(excess * (std::abs(a) + maxAcceleration) / (2. * J), a);
    a = std::copysign(maxAcceleration, a);
  }
  // Reducing the acceleration to zero at once would end at this velocity; the difference decides the direction.
  const double missing = target - (v + a * std::abs(a) / (2. * J));
  const double d = missing < 0. ? -1. : 1.;
  const double aAlong = d * a;
  const double change = d * (target - v);
  const double free = std::sqrt(std::max(J * change + 0.5 * a * a, 0.));
  const double peak = std::max(std::min(maxAcceleration, free), std::max(aAlong, 0.));
  const double hold = free > peak && peak > 0. ? (change - (2. * peak * peak - a * a) / (2. * J)) / peak : 0.;
  add((peak - aAlong) / J, d * J);
  add(hold, 0.);
  add(peak / J, -d * J);
}

void vpVelocityRamp::add(double duration, double jerk)
{
  if (duration > 0.) {
    m_pieces[static_cast<std::size_t>(m_count++)] = {duration, jerk};
    m_duration += duration;
  }
}

vpAxisState vpVelocityRamp::at(double q, double t) const noexcept
{
  double v = m_v, a = m_a;
  for (int i = 0; i < m_count; ++i) {
    const Piece &p = piece(i);
    const double dt = std::min(t, p.duration);
    q += dt * (v + dt * (a / 2. + dt * p.jerk / 6.));
    v += dt * (a + dt * p.jerk / 2.);
    a += dt * p.jerk;
    t -= dt;
    if (t <= 0. && dt < p.duration) {
      return {q, v, a, p.jerk};
    }
  }
  return {q + t * m_target, m_target, 0., 0.}; // without the rounding of the pieces
}

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
} // namespace

double vpAxisTask::rampUnit() const
{
  const double scale = limits.velocity / limits.acceleration;
  return std::isfinite(scale) && scale > 0. ? 0.1 * scale : timeUnit;
}

double vpAxisTask::brakeAcceleration() const
{
  if (std::isfinite(limits.acceleration)) {
    return limits.acceleration;
  }
  // Without a limit: stop within the ramp unit.
  const double fast = std::isfinite(limits.velocity) ? limits.velocity : std::max(std::abs(from[1]), std::abs(to[1]));
  const double needed =
      std::max({std::abs(from[2]), std::abs(to[2]), std::abs(from[1]) / rampUnit(), fast / rampUnit()});
  return needed > 0. ? needed : 1.;
}

double vpAxisTask::brakeJerk(const vpAxisState &x, double hardness) const
{
  // While the acceleration ramps down, it adds a^2/(2 j) to the velocity. A margin that a ramp of a millionth of the
  // usual duration exceeds counts as zero; rampDuration() agrees.
  const double usual = brakeAcceleration() / rampUnit(), room = limits.velocity - std::copysign(1., x[2]) * x[1];
  const double least = 1e-6 * std::min(limits.velocity, x[2] * x[2] / (2. * usual));
  const bool near = order > 2 && x[2] != 0. && room > 0. && std::isfinite(room);
  return std::min(limits.jerk, std::max(hardness * usual, near ? x[2] * x[2] / (2. * std::max(room, least)) : 0.));
}

vpAxisTask vpAxisTask::harder(double hardness) const
{
  vpAxisTask task = *this;
  double &a = task.limits.acceleration;
  a = std::isfinite(a) ? a : brakeAcceleration() * std::sqrt(hardness);
  return task;
}

std::pair<double, double> vpAxisTask::brakingWays() const
{
  const auto stop = [this](double v, double a) {
    if (order == 2) {
      return v * std::abs(v) / (2. * brakeAcceleration());
    }
    if (v == 0. && a == 0.) {
      return 0.;
    }
    const vpVelocityRamp ramp(v, a, 0., brakeAcceleration(), brakeJerk({0., v, a, 0.}));
    return ramp.at(0., ramp.duration())[0];
  };
  return {stop(from[1], from[2]), -stop(-to[1], to[2])};
}

bool vpAxisTask::isMoving() const
{
  for (std::size_t k = 1; k < static_cast<std::size_t>(order); ++k) {
    if (from[k] != 0. || to[k] != 0.) {
      return true;
    }
  }
  return false;
}

vpAxisLimits vpAxisTask::withoutPosition() const
{
  vpAxisLimits free = limits;
  free.minPosition = -infinity;
  free.maxPosition = infinity;
  return free;
}

double rampDuration(const vpAxisState &x, const vpAxisTask &task, int order) noexcept
{
  const double a = std::abs(x[2]);
  if (order == 2 || (a == 0. && (order == 3 || x[3] == 0.))) {
    return 0.;
  }
  if (order == 4) {
    // Cubic acceleration: any sufficiently short ramp keeps an inside start; take the longest of a few.
    const vpMotionFamily ramp = vpMotionFamily::accelerationStep(x, {x[0], x[1], 0., 0.}, 2);
    double r = 4. * task.rampUnit();
    for (int i = 0; i < 40; ++i, r *= 0.5) {
      if (vpMinimumDuration::isFeasible(ramp, task.withoutPosition(), r)) {
        return r;
      }
    }
    return -1.;
  }
  const double room = task.limits.velocity - std::copysign(1., x[2]) * x[1];
  // Without an acceleration limit for comparison: change the velocity by a tenth of its limit.
  const double gentle = std::isfinite(task.limits.acceleration)
                            ? a / std::min(task.limits.jerk, task.brakeAcceleration() / task.rampUnit())
                            : std::max(0.2 * task.limits.velocity / a, a / task.limits.jerk);
  const double r = std::min(gentle, 2. * room / a);
  const bool tooHard = r < a / task.limits.jerk * (1. - 1e-9);
  return tooHard || r < 1e-6 * gentle ? -1. : r;
}

bool needsBraking(const vpAxisTask &task) noexcept
{
  const double slack = 1. + 1e-12;
  if (std::abs(task.from[1]) > task.limits.velocity * slack ||
      (task.order == 4 && std::abs(task.from[3]) > task.limits.jerk * slack)) {
    return true;
  }
  return task.order > 2 &&
         (std::abs(task.from[2]) > task.limits.acceleration * slack || rampDuration(task.from, task, 3) < 0.);
}

namespace
{
constexpr int halvings = 40;

// Lowest and highest place of ramps one after the other.
struct Extent {
  double low = 0., high = 0., place = 0.;

  void include(double q)
  {
    low = std::min(low, q);
    high = std::max(high, q);
  }
  void add(const vpVelocityRamp &ramp, double v, double a)
  {
    for (int i = 0; i < ramp.count(); ++i) {
      const double d = ramp.piece(i).duration, j = ramp.piece(i).jerk;
      const auto way = [&](double t) { return t * (v + t * (a / 2. + t * j / 6.)); };
      const double square = a * a - 2. * j * v;
      if (square >= 0.) { // v + a t + j t^2/2 = 0
        const double sum = -(a + std::copysign(std::sqrt(square), a));
        for (const double t : {sum / j, 2. * v / sum}) {
          if (t > 0. && t < d) {
            include(place + way(t));
          }
        }
      }
      place += way(d);
      include(place);
      v += d * (a + d * j / 2.);
      a += d * j;
    }
  }
};
} // namespace

vpHardStop::vpHardStop(const vpAxisState &x, const vpAxisTask &task, double low, double high) noexcept
{
  // Without a jerk limit up to ten thousand times harder than usual: within 1e-4 of what no jerk could better.
  constexpr double hardest = 1e4;
  for (double hardness = 1.;; hardness *= 10.) {
    const vpAxisTask harder = task.harder(hardness);
    acceleration = harder.brakeAcceleration();
    jerk = harder.brakeJerk(x, hardness);
    const bool free = low == -infinity && high == infinity;
    if (free || task.order == 2 || !(excess(x, low, high, 1.) > 0. || excess(x, low, high, -1.) > 0.)) {
      return;
    }
    if (hardness >= hardest || (jerk >= task.limits.jerk && std::isfinite(task.limits.acceleration))) {
      break;
    }
  }
  if (jerk >= task.limits.jerk) {
    turnBack(x, task, low, high);
  }
}

// By how much the stop goes beyond the place on this side; negative: it does not.
double vpHardStop::excess(const vpAxisState &x, double low, double high, double side) const noexcept
{
  Extent extent;
  double v = x[1], a = x[2];
  for (int i = 0; i < count; ++i) {
    const double target = velocities[static_cast<std::size_t>(i)];
    extent.add(vpVelocityRamp(v, a, target, acceleration, jerk), v, a);
    v = target;
    a = 0.;
  }
  return side > 0. ? extent.high - high : low - extent.low;
}

void vpHardStop::turnBack(const vpAxisState &x, const vpAxisTask &task, double low, double high) noexcept
{
  const double v = x[1], a = x[2], J = jerk, fastest = task.limits.velocity;
  const double side = std::copysign(1., v != 0. ? v : -a); // where the first turn is
  if (!std::isfinite(task.limits.acceleration)) {
    acceleration = std::max(acceleration, std::sqrt(a * a + J * (std::abs(v) + fastest))); // never reached
  }
  const double natural = v + a * std::abs(a) / (2. * J); // when the acceleration is taken back at once
  const double least = std::sqrt(2. * J * std::max(0., -side * natural));
  const double allowed = std::min(acceleration, std::sqrt(2. * J * fastest)), most = std::max(least, allowed);
  const auto turn = [&](double b, double c) {
    count = 0;
    if (b > least * (1. + 1e-6)) {
      velocities[static_cast<std::size_t>(count++)] = -side * b * b / (2. * J);
    }
    if (c > 0.) {
      velocities[static_cast<std::size_t>(count++)] = side * c * c / (2. * J);
    }
    velocities[static_cast<std::size_t>(count++)] = 0.;
  };
  const auto isKept = [&](double s) { return !(excess(x, low, high, s) > 0.); };
  // The mildest turn that keeps the first place, but none that leaves the other.
  double mild = least, hard = most;
  const auto isEnough = [&](double b) {
    turn(b, 0.);
    return isKept(side) || !isKept(-side);
  };
  hard = isEnough(mild) ? mild : hard;
  for (int i = 0; i < halvings && hard > mild; ++i) {
    const double b = 0.5 * (mild + hard);
    (isEnough(b) ? hard : mild) = b;
  }
  turn(hard, 0.);
  if (!isKept(-side)) {
    turn(mild, 0.);
  }
  if (!isKept(-side)) { // b = least: the mildest second turn that keeps it
    mild = 0.;
    hard = 0.98 * std::min(least, allowed);
    for (int i = 0; i < halvings; ++i) {
      const double c = 0.5 * (mild + hard);
      turn(least, c);
      (isKept(-side) ? hard : mild) = c;
    }
    turn(least, hard);
  }
}

END_VISP_NAMESPACE
