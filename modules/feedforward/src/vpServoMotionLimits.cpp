/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpServoMotionLimits.h>

BEGIN_VISP_NAMESPACE

const vpFields<vpServoMotionLimits> &vpServoMotionLimits::fields()
{
  using Limits = vpServoMotionLimits;
  const vpFieldRange positive = vpFieldRange::positive(1e6);
  vpFieldRange jerk = vpFieldRange::positive(1e9);
  jerk.infinite = true;
  static const vpFields<Limits> all = {
      {"linearVelocity", &Limits::linearVelocity, positive, "m/s", "Limit of the linear speed"},
      {"linearAcceleration", &Limits::linearAcceleration, positive, "m/s^2", "Limit of the linear acceleration"},
      {"linearJerk", &Limits::linearJerk, jerk, "m/s^3", "Limit of the linear jerk"},
      {"angularVelocity", &Limits::angularVelocity, positive, "rad/s", "Limit of the angular speed"},
      {"angularAcceleration", &Limits::angularAcceleration, positive, "rad/s^2", "Limit of the angular acceleration"},
      {"angularJerk", &Limits::angularJerk, jerk, "rad/s^3", "Limit of the angular jerk"},
  };
  return all;
}

void vpServoMotionLimits::validate() const { vpCheckFields(*this, fields(), "the servo motion limits"); }

vpServoMotionLimits vpServoMotionLimits::scaled(double linear, double angular) const
{
  return {linear * linearVelocity,   linear * linearAcceleration,   linear * linearJerk,
          angular * angularVelocity, angular * angularAcceleration, angular * angularJerk};
}

vpServoMotionLimits vpServoMotionLimits::slowed(double factor) const
{
  const double square = factor * factor, cube = square * factor;
  return {factor * linearVelocity,  square * linearAcceleration,  cube * linearJerk,
          factor * angularVelocity, square * angularAcceleration, cube * angularJerk};
}

vpTwistShaperLimits vpServoMotionLimits::shaperLimits() const
{
  return {linearAcceleration, linearJerk, angularAcceleration, angularJerk};
}

END_VISP_NAMESPACE
