/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpTwistShaper.h>
#include <visp3/trajectory/vpVelocityRamp.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
void requirePositive(const char *name, double value, const char *unit)
{
  if (!(value > 0.)) {
    throw vpException(vpException::badValue, "%s of the twist shaper is %g %s, must be > 0", name, value, unit);
  }
}

// Shares of a norm limit for the components: in the direction of the wished change as far as the accelerations in
// progress leave room, w_i = max(|b_i|, lambda d_i) with the largest lambda that keeps the norm of w at 1.
void shareLimit(const double (&busy)[3], const double (&wish)[3], double (&w)[3])
{
  double low = 0., high = 1.;
  const auto norm2 = [&](double lambda) {
    double sum = 0.;
    for (int i = 0; i < 3; ++i) {
      w[i] = std::max(busy[i], lambda * wish[i]);
      sum += w[i] * w[i];
    }
    return sum;
  };
  if (norm2(high) <= 1.) {
    return;
  }
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (norm2(middle) <= 1. ? low : high) = middle;
  }
  static_cast<void>(norm2(low));
}
} // namespace

void vpTwistShaperLimits::validate() const
{
  requirePositive("linear acceleration limit", linearAcceleration, "m/s^2");
  requirePositive("linear jerk limit", linearJerk, "m/s^3");
  requirePositive("angular acceleration limit", angularAcceleration, "rad/s^2");
  requirePositive("angular jerk limit", angularJerk, "rad/s^3");
}

vpTwistShaper::vpTwistShaper(const vpTwistShaperLimits &limits) { setLimits(limits); }

void vpTwistShaper::reset(const vpTwist &twist, const vpTwist &acceleration)
{
  m_twist = twist;
  m_acceleration = acceleration;
}

void vpTwistShaper::setLimits(const vpTwistShaperLimits &limits)
{
  limits.validate();
  m_limits = limits;
}

vpTwist vpTwistShaper::update(const vpTwist &raw, double dt) noexcept
{
  if (!(dt > 0.) || !std::isfinite(dt)) {
    return m_twist;
  }
  const vpTwist wished = raw.isFinite() ? raw : vpTwist();
  updatePart(0, wished, m_limits.linearAcceleration, m_limits.linearJerk, dt);
  updatePart(3, wished, m_limits.angularAcceleration, m_limits.angularJerk, dt);
  return m_twist;
}

void vpTwistShaper::updatePart(int first, const vpTwist &raw, double maxAcceleration, double maxJerk,
                               double dt) noexcept
{
  const auto part = [first](int i) { return static_cast<std::size_t>(first + i); };
  double share[3] = {1., 1., 1.}, jerkShare[3] = {1., 1., 1.};
  if (m_limits.norm) {
    double busy[3], wish[3], length2 = 0., busy2 = 0.;
    for (int i = 0; i < 3; ++i) {
      wish[i] = std::abs(raw[part(i)] - m_twist[part(i)]);
      busy[i] = std::abs(m_acceleration[part(i)]) / maxAcceleration;
      length2 += wish[i] * wish[i];
      busy2 += busy[i] * busy[i];
    }
    if (length2 == 0. && busy2 == 0.) {
      return;
    }
    const double fit = busy2 > 1. ? 1. / std::sqrt(busy2) : 1.; // limits lowered on the fly
    for (int i = 0; i < 3; ++i) {
      wish[i] = length2 > 0. ? wish[i] / std::sqrt(length2) : 0.;
      busy[i] *= fit;
    }
    shareLimit(busy, wish, share);
    const double norm = std::sqrt(share[0] * share[0] + share[1] * share[1] + share[2] * share[2]);
    for (int i = 0; i < 3; ++i) {
      jerkShare[i] = share[i] / norm;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double v = m_twist[part(i)], a = m_acceleration[part(i)], target = raw[part(i)];
    if (share[i] <= 0.) {
      continue; // at its target and at rest
    }
    if (std::isfinite(maxJerk)) {
      const vpVelocityRamp ramp(v, a, target, share[i] * maxAcceleration, jerkShare[i] * maxJerk);
      const vpAxisState next = ramp.at(0., dt);
      m_twist[part(i)] = next[1];
      m_acceleration[part(i)] = next[2];
    }
    else {
      const double limit = share[i] * maxAcceleration;
      m_acceleration[part(i)] = std::clamp((target - v) / dt, -limit, limit);
      m_twist[part(i)] = std::abs(target - v) <= limit * dt ? target : v + dt * m_acceleration[part(i)];
    }
  }
}

END_VISP_NAMESPACE
