/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpApproachSpeed.h
 * \brief Speed from which bounded acceleration and jerk can still follow a law to its goal.
 */
#ifndef vpApproachSpeed_h
#define vpApproachSpeed_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

//! The motion that is commanded now, along the twist of a law.
struct vpCommandedAlong {
  double speed, acceleration;
};

/*!
 * \brief Share of a law's speed that leaves no overshoot behind bounds.
 *
 * The law v = gain d slows down by gain v. Where that is more than an acceleration a, v is limited to
 * sqrt(2 a (d - d0)), constant deceleration up to v = a / gain, with d0 = a / (2 gain^2): both curves meet there with the
 * same slope. The way that passes until the jerk has turned the present acceleration into -a is taken off d. The jerk of the
 * law is gain^2 v <= gain a. a leaves a rest of both bounds for what disturbs.
 * \param speed : Of the law. \param gain : > 0. \param acceleration, jerk : Bounds, > 0. \param now : Commanded motion.
 */
inline double vpApproachShare(double speed, double gain, double acceleration, double jerk,
                              const vpCommandedAlong &now) noexcept
{
  const double a = std::min(0.7 * acceleration, 0.5 * jerk / gain);
  if (!(gain * speed > a)) {
    return 1.;
  }
  const double turning = std::max(0., now.acceleration + a) / jerk; // s
  const double way = speed / gain - 0.5 * turning * std::max(0., now.speed);
  return std::clamp(std::sqrt(2. * a * std::max(0., way - 0.5 * a / (gain * gain))) / speed, a / (gain * speed), 1.);
}

END_VISP_NAMESPACE
#endif
