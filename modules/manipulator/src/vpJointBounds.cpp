/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/manipulator/vpJointBounds.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Largest velocity towards a limit that is so far away; beyond the limit: back, as fast as that way takes.
double towards(double room, double velocity, double acceleration, double period)
{
  if (!(room < std::numeric_limits<double>::infinity())) {
    return velocity;
  }
  if (room < 0.) {
    return -towards(-room, velocity, acceleration, period);
  }
  // The same as a (sqrt(dt^2 + 2 room / a) - dt), without the difference of two large numbers.
  return std::min(velocity, 2. * room / (period + std::sqrt(period * period + 2. * room / acceleration)));
}
} // namespace

void vpJointBounds::update(const vpArmModel &model, const vpJointVector &q, const vpJointVector &previous,
                           double period, double margin) noexcept
{
  const int n = model.size();
  velocityLimit = model.velocity();
  lower.resize(n);
  upper.resize(n);
  roomBelow.resize(n);
  roomAbove.resize(n);
  accelerationLower = previous - period * model.acceleration();
  accelerationUpper = previous + period * model.acceleration();
  for (int i = 0; i < n; ++i) {
    const double v = velocityLimit(i), a = model.acceleration()(i);
    roomAbove(i) = model.upper()(i) - margin - q(i);
    roomBelow(i) = q(i) - model.lower()(i) - margin;
    upper(i) = towards(roomAbove(i), v, a, period);
    lower(i) = -towards(roomBelow(i), v, a, period);
  }
}

double vpJointBounds::together(const vpArmModel &model, const vpJointVector &direction, double period) const noexcept
{
  const int n = model.size();
  double braking = std::numeric_limits<double>::infinity(); // of the factor, 1/s
  for (int i = 0; i < n; ++i) {
    if (std::fabs(direction(i)) > 0.) {
      braking = std::min(braking, model.acceleration()(i) / std::fabs(direction(i)));
    }
  }
  double factor = 1.;
  for (int i = 0; i < n; ++i) {
    const double v = std::fabs(direction(i)), room = direction(i) > 0. ? roomAbove(i) : roomBelow(i);
    if (v > 1e-12 && room < std::numeric_limits<double>::infinity()) {
      // The direction turns on the way, so half of the deceleration is kept in hand.
      const double most = room > 0. ? towards(room, v, 0.5 * braking * v, period) : 0.;
      factor = std::min(factor, most / v);
    }
  }
  return factor;
}

double vpJointBounds::clamp(int i, double wanted) const noexcept
{
  double v = std::min(std::max(wanted, lower(i)), upper(i));
  v = std::min(std::max(v, accelerationLower(i)), accelerationUpper(i));
  return std::min(std::max(v, -velocityLimit(i)), velocityLimit(i));
}

END_VISP_NAMESPACE
