/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/manipulator/vpJointBounds.h>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Largest velocity towards a limit at distance room; beyond the limit: back, at the speed for that distance.
double towards(double room, double velocity, double acceleration, double period)
{
  if (room == infinity) {
    return velocity;
  }
  if (room < 0.) {
    return -towards(-room, velocity, acceleration, period);
  }
  // Equals a (sqrt(dt^2 + 2 room / a) - dt), without the difference of two large numbers.
  return std::min(velocity, 2. * room / (period + std::sqrt(period * period + 2. * room / acceleration)));
}

double plausible(const vpJointVector &numbers, int i)
{
  return i < numbers.size() && std::fabs(numbers(i)) <= vpArmLargest ? numbers(i) : unknown;
}
} // namespace

bool vpJointBounds::update(const vpArmModel &model, const vpJointVector &q, const vpJointVector &previous,
                           double period, double margin) noexcept
{
  const int n = model.size();
  velocityLimit = model.velocity();
  for (vpJointVector *bound : {&lower, &upper, &roomBelow, &roomAbove, &accelerationLower, &accelerationUpper}) {
    bound->setZero(n);
  }
  const bool timed = period > 0. && period <= vpArmLargest && margin >= 0. && margin <= vpArmLargest;
  bool good = timed && q.size() == n && previous.size() == n;
  for (int i = 0; i < n; ++i) {
    const double place = plausible(q, i), before = plausible(previous, i);
    good = good && !std::isnan(place) && !std::isnan(before);
    if (!timed) { // all stop
      continue;
    }
    const double v = velocityLimit(i), a = model.acceleration()(i), now = std::isnan(before) ? 0. : before;
    accelerationLower(i) = now - period * a;
    accelerationUpper(i) = now + period * a;
    if (!std::isnan(place)) {
      roomAbove(i) = model.upper()(i) - margin - place;
      roomBelow(i) = place - model.lower()(i) - margin;
      upper(i) = towards(roomAbove(i), v, a, period);
      lower(i) = -towards(roomBelow(i), v, a, period);
    }
  }
  return good;
}

double vpJointBounds::together(const vpArmModel &model, const vpJointVector &direction, double period) const noexcept
{
  const int n = model.size();
  if (direction.size() != n || !direction.allFinite()) {
    return 0.;
  }
  double braking = infinity; // deceleration of the factor, 1/s
  for (int i = 0; i < n; ++i) {
    if (std::fabs(direction(i)) > 0.) {
      braking = std::min(braking, model.acceleration()(i) / std::fabs(direction(i)));
    }
  }
  double factor = 1.;
  for (int i = 0; i < n; ++i) {
    const double v = std::fabs(direction(i)), room = direction(i) > 0. ? roomAbove(i) : roomBelow(i);
    if (v > 1e-12 && room < infinity) {
      // The direction changes during braking, so half of the deceleration is kept in reserve.
      const double most = room > 0. ? towards(room, v, 0.5 * braking * v, period) : 0.;
      factor = std::min(factor, most / v);
    }
  }
  return factor;
}

double vpJointBounds::clamp(int i, double wanted) const noexcept
{
  double v = std::isnan(wanted) ? 0. : wanted;
  v = std::min(std::max(v, lower(i)), upper(i));
  v = std::min(std::max(v, accelerationLower(i)), accelerationUpper(i));
  return std::min(std::max(v, -velocityLimit(i)), velocityLimit(i));
}

END_VISP_NAMESPACE
