/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpTwistShaper.h>
#include <visp3/trajectory/vpVelocityRamp.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Eigen::Vector3d;

// Rounding must not keep a ramp from arriving at the bound.
constexpr double rounding = 1e-12;

// Finite and within the range of a machine.
bool isPlausible(const vpTwist &twist)
{
  for (std::size_t i = 0; i < 6; ++i) {
    if (!(std::abs(twist[i]) <= vpTwistShaper::implausible)) {
      return false;
    }
  }
  return true;
}

// The linear or the angular part.
struct Motion {
  Vector3d v, a;
};

struct Bounds {
  double acceleration, jerk;
  bool norm;

  double size(const Vector3d &a) const { return norm ? a.norm() : a.cwiseAbs().maxCoeff(); }
};

// Shares of a norm limit for the components: in the direction of the desired change as far as the current accelerations
// allow, w_i = max(|b_i|, lambda d_i) with the largest lambda that keeps the norm of w at 1.
Vector3d shareLimit(const Vector3d &busy, const Vector3d &wish)
{
  const auto share = [&](double lambda) { return Vector3d(busy.cwiseMax(lambda * wish)); };
  if (share(1.).squaredNorm() <= 1.) {
    return share(1.);
  }
  double low = 0., high = 1.;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (share(middle).squaredNorm() <= 1. ? low : high) = middle;
  }
  return share(low);
}

// Time-optimal ramps of the components, after dt.
Motion rampTo(const Vector3d &target, const Motion &now, const Bounds &bounds, double dt)
{
  Vector3d share = Vector3d::Ones(), jerkShare = share;
  if (bounds.norm) {
    const Vector3d change = (target - now.v).cwiseAbs(), busy = now.a.cwiseAbs() / bounds.acceleration;
    const double length = change.norm(), most = busy.norm();
    if (length == 0. && most == 0.) {
      return now;
    }
    share = shareLimit(busy / std::max(1., most), length > 0. ? Vector3d(change / length) : Vector3d(change));
    jerkShare = share / share.norm();
  }
  Motion next = now;
  for (int i = 0; i < 3; ++i) {
    if (share[i] <= 0.) {
      continue; // at its target and at rest
    }
    const double limit = share[i] * bounds.acceleration, missing = target[i] - now.v[i];
    if (std::isfinite(bounds.jerk)) {
      const vpAxisState state =
          vpVelocityRamp(now.v[i], now.a[i], target[i], limit, jerkShare[i] * bounds.jerk).at(0., dt);
      next.v[i] = state[1];
      next.a[i] = state[2];
    }
    else {
      next.a[i] = std::clamp(missing / dt, -limit, limit);
      next.v[i] = std::abs(missing) <= limit * dt ? target[i] : now.v[i] + dt * next.a[i];
    }
  }
  return next;
}

// Full jerk against the acceleration until it is zero, after dt: the velocity goes straight to its final value where().
Motion brake(const Motion &now, const Bounds &bounds, double dt)
{
  const double time = std::isfinite(bounds.jerk) ? bounds.size(now.a) / bounds.jerk : 0.;
  if (time <= dt) {
    return {now.v + 0.5 * time * now.a, Vector3d::Zero()};
  }
  const double left = 1. - dt / time;
  return {now.v + 0.5 * dt * (1. + left) * now.a, left * now.a};
}

// The largest speed now and while braking.
double peak(const Motion &motion, const Bounds &bounds)
{
  const double time = std::isfinite(bounds.jerk) ? bounds.size(motion.a) / bounds.jerk : 0.;
  return std::max(motion.v.norm(), (motion.v + 0.5 * time * motion.a).norm());
}
} // namespace

const vpFields<vpTwistShaperLimits> &vpTwistShaperLimits::fields()
{
  using Limits = vpTwistShaperLimits;
  const vpFieldRange acceleration{1e-6, 1e9}, jerk{1e-6, 1e12, false, true};
  static const vpFields<Limits> all = {
      {"linearAcceleration", &Limits::linearAcceleration, acceleration, "m/s^2", "Limit of the linear acceleration"},
      {"linearJerk", &Limits::linearJerk, jerk, "m/s^3", "Limit of the linear jerk"},
      {"angularAcceleration", &Limits::angularAcceleration, acceleration, "rad/s^2",
       "Limit of the angular acceleration"},
      {"angularJerk", &Limits::angularJerk, jerk, "rad/s^3", "Limit of the angular jerk"},
  };
  return all;
}

void vpTwistShaperLimits::validate() const { vpCheckFields(*this, fields(), "the twist shaper"); }

vpTwistShaper::vpTwistShaper(const vpTwistShaperLimits &limits) { setLimits(limits); }

void vpTwistShaper::reset(const vpTwist &twist, const vpTwist &acceleration)
{
  const bool usable = isPlausible(twist) && isPlausible(acceleration);
  m_twist = usable ? twist : vpTwist();
  m_acceleration = usable ? acceleration : vpTwist();
}

void vpTwistShaper::setLimits(const vpTwistShaperLimits &limits)
{
  limits.validate();
  m_limits = limits;
}

vpTwist vpTwistShaper::step(const vpTwist &raw, double dt) noexcept
{
  if (!(dt > 0.) || !std::isfinite(dt)) {
    return m_twist;
  }
  const vpTwist wished = isPlausible(raw) ? raw : vpTwist();
  const double step = std::min(dt, longestStep);
  updatePart(0, wished, m_limits.linearAcceleration, m_limits.linearJerk, step);
  updatePart(3, wished, m_limits.angularAcceleration, m_limits.angularJerk, step);
  return m_twist;
}

void vpTwistShaper::updatePart(std::size_t first, const vpTwist &raw, double maxAcceleration, double maxJerk,
                               double dt) noexcept
{
  const Bounds bounds{maxAcceleration, maxJerk, m_limits.norm};
  const Motion now{Eigen::Map<const Vector3d>(m_twist.data() + first),
                   Eigen::Map<const Vector3d>(m_acceleration.data() + first)};
  const Vector3d target = Eigen::Map<const Vector3d>(raw.data() + first);
  Motion next = rampTo(target, now, bounds, dt);
  const double most = std::max(target.norm(), peak(now, bounds)) * (1. + rounding);
  if (!(peak(next, bounds) <= most)) {
    // Straight towards the input, which from rest never leaves the ball: ramps with separate limits per component
    // might, and nothing of them would be left.
    const Motion ramp = m_limits.norm ? next : rampTo(target, now, {maxAcceleration, maxJerk, true}, dt);
    const Motion slow = brake(now, bounds, dt);
    const auto mixed = [&](double share) {
      return Motion{slow.v + share * (ramp.v - slow.v), slow.a + share * (ramp.a - slow.a)};
    };
    double low = 0., high = 1.;
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (low + high);
      (peak(mixed(middle), bounds) <= most ? low : high) = middle;
    }
    next = mixed(low);
    if (std::isinf(maxJerk)) {
      next.a = (next.v - now.v) / dt;
    }
  }
  for (int i = 0; i < 3; ++i) {
    m_twist[first + static_cast<std::size_t>(i)] = next.v[i];
    m_acceleration[first + static_cast<std::size_t>(i)] = next.a[i];
  }
}

END_VISP_NAMESPACE
