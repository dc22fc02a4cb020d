/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoMotionLimits.h
 * \brief Limits of the camera's velocity, acceleration and jerk in visual servoing.
 */
#ifndef vpServoMotionLimits_h
#define vpServoMotionLimits_h

#include <visp3/direct_core/vpField.h>
#include <visp3/trajectory/vpTwistShaper.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_feedforward
 * \brief Limits of the camera's motion: Euclidean norms of the linear and of the angular part of the commanded twist
 * and of its first and second derivative, components in the camera frame.
 */
struct VISP_EXPORT vpServoMotionLimits {
  double linearVelocity = 0.25;    //!< Limit of the linear speed, m/s, > 0, <= 1000000.
  double linearAcceleration = 0.5; //!< Limit of the linear acceleration, m/s^2, > 0, <= 1000000.
  double linearJerk = 5.;          //!< Limit of the linear jerk, m/s^3, > 0, <= 1e+09 or infinite.
  double angularVelocity = 1.;     //!< Limit of the angular speed, rad/s, > 0, <= 1000000.
  double angularAcceleration = 2.; //!< Limit of the angular acceleration, rad/s^2, > 0, <= 1000000.
  double angularJerk = 20.;        //!< Limit of the angular jerk, rad/s^3, > 0, <= 1e+09 or infinite.

  //! The limits with their ranges and units.
  [[nodiscard]] static const vpFields<vpServoMotionLimits> &fields();
  //! \throw vpException (badValue) naming the limit and its value when one is out of its range.
  void validate() const;
  //! Limits of a part of every motion: all of the linear part times \e linear, of the angular part times \e angular.
  [[nodiscard]] vpServoMotionLimits scaled(double linear, double angular) const;
  //! Limits of the same motions, slower by \e factor: speeds times factor, accelerations times its square, jerks its cube.
  [[nodiscard]] vpServoMotionLimits slowed(double factor) const;
  //! Accelerations and jerks as the limits of a vpTwistShaper.
  [[nodiscard]] vpTwistShaperLimits shaperLimits() const;
};

END_VISP_NAMESPACE
#endif
