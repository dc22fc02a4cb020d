/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
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

END_VISP_NAMESPACE
