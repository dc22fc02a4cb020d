/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlanFeedback.h"

BEGIN_VISP_NAMESPACE

namespace
{
// Gains in units of lambda and of the integral's gain, the part of an acceleration with which the camera comes to rest.
constexpr double linearGain = 4., integralGain = 4., braking = 0.7;
// At rest the feedback stops below the first of these multiples of the zone, until the error is beyond the other, or beyond the
// first for this time, s.
constexpr double settled = 0.4, unsettled = 1., patience = 1.;

// Of what a plan leaves, the parts in use: faster feedback arrives no sooner against stiction, and makes more jerk.
constexpr double accelerationShare = 0.3, jerkShare = 0.15;

vpTwistNorms shares()
{
  vpTwistNorms parts;
  parts << 1., accelerationShare, jerkShare, 1., accelerationShare, jerkShare;
  return parts;
}

// Least limit of a vpTwistShaper.
constexpr double least = 1e-6;

vpTwistShaperLimits shaperLimits(const vpTwistNorms &limits)
{
  return {std::max(limits[1], least), std::max(limits[2], least), std::max(limits[4], least),
          std::max(limits[5], least)};
}

// In proportion to the error, but not faster than the camera can come to rest at its end.
Eigen::Vector3d approach(const Eigen::Vector3d &error, double gain, double acceleration)
{
  const double length = std::max(error.norm(), 1e-300);
  return error * std::min(gain, std::sqrt(2. * braking * acceleration / length));
}

Eigen::Vector3d atMost(const Eigen::Vector3d &x, double limit)
{
  return x * std::min(1., limit / std::max(x.norm(), 1e-300));
}
} // namespace

vpPlanFeedback::vpPlanFeedback(const vpServoGains &gains, const vpServoMotionLimits &rest)
  : m_linearGain(linearGain * gains.lambda), m_angularGain(angularGain * gains.lambda * gains.rotation),
    m_integralGain(integralGain * gains.integral), m_integralLimit(gains.integralLimit),
    m_rest(vpTwistExcess::normsOf(rest)), m_shaper(rest.shaperLimits())
{}

void vpPlanFeedback::setRest(const vpServoMotionLimits &rest) noexcept
{
  m_rest = vpTwistExcess::normsOf(rest);
  m_small = 0;
}

void vpPlanFeedback::reset(const Vector6 &twist, const Vector6 &rate) noexcept
{
  m_shaper.reset(vpTwistSpline::toTwist(twist), vpTwistSpline::toTwist(rate));
  m_integral.setZero();
  m_small = isWithinRest() ? m_small : 0;
}

vpPlanFeedback::Vector6 vpPlanFeedback::step(const Eigen::Vector3d &shift, const Eigen::Vector3d &turn,
                                             const Vector6 &planned, bool isAtRest, const vpTwistNorms &room,
                                             bool mustBeSmall, double dt) noexcept
{
  for (int i = 0; i < 3; ++i) {
    const double w = planned[i + 3];
    if (w * m_integral[i] < 0. && std::abs(w) > std::abs(m_integral[i])) {
      m_integral[i] = 0.; // friction has reversed
    }
  }
  const vpTwistNorms usable = m_rest.max(room * shares());
  const double off = size(shift.norm(), turn.norm());
  m_outside = off < settled ? 0. : m_outside + dt;
  m_settled = isAtRest && (off < settled || (m_settled && off < unsettled && m_outside < patience));
  Vector6 wished = Vector6::Zero();
  if (m_settled) {
    m_integral.setZero();
  }
  else {
    wished = wish(shift, turn, mustBeSmall ? m_rest : usable, dt);
  }
  m_shaper.setLimits(shaperLimits(mustBeSmall && isWithinRest() ? m_rest : usable));
  const Vector6 twist = vpTwistSpline::fromTwist(m_shaper.step(vpTwistSpline::toTwist(wished), dt));
  m_small = isWithinRest() ? std::min(m_small + 1, 2) : 0;
  return twist;
}

// The integral stands still while the rotation is as fast as it may be.
vpPlanFeedback::Vector6 vpPlanFeedback::wish(const Eigen::Vector3d &shift, const Eigen::Vector3d &turn,
                                             const vpTwistNorms &limits, double dt) noexcept
{
  const Eigen::Vector3d v = approach(shift, m_linearGain, limits[1]);
  const Eigen::Vector3d w = approach(turn, m_angularGain, limits[4]) + m_integral;
  if (w.norm() <= limits[3] || turn.dot(m_integral) < 0.) {
    m_integral = atMost(m_integral + m_integralGain * dt * turn, m_integralLimit);
  }
  Vector6 twist;
  twist << atMost(v, limits[0]), atMost(w, limits[3]);
  return twist;
}

bool vpPlanFeedback::isWithinRest() const
{
  const Vector6 y = vpTwistSpline::fromTwist(m_shaper.twist()), a = vpTwistSpline::fromTwist(m_shaper.acceleration());
  const auto within = [](const Eigen::Vector3d &v, const Eigen::Vector3d &rate, double speed, double acceleration,
                         double jerk) {
    const double most = 1. + 1e-9, slope = rate.norm();
    return slope <= most * acceleration && std::max(v.norm(), (v + 0.5 * slope / jerk * rate).norm()) <= most * speed;
  };
  return within(y.head<3>(), a.head<3>(), m_rest[0], m_rest[1], m_rest[2]) &&
         within(y.tail<3>(), a.tail<3>(), m_rest[3], m_rest[4], m_rest[5]);
}

END_VISP_NAMESPACE
