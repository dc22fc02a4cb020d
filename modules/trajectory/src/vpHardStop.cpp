/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpHardStop.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

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
    if (task.order == 2 || !(excess(x, low, high, 1.) > 0. || excess(x, low, high, -1.) > 0.)) {
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
