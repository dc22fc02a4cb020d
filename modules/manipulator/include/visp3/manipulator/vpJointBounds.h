/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointBounds.h
 * \brief Which joint velocities may be commanded now so that the limits still hold later.
 */
#ifndef vpJointBounds_h
#define vpJointBounds_h

#include <visp3/manipulator/vpArmModel.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Interval of velocities of each joint for the next period, rad/s or m/s.
 *
 * A joint that moves for one period and then brakes at its acceleration limit shall end before its position limit:
 * v dt + v^2 / (2 a) <= room, so v <= a (sqrt(dt^2 + 2 room / a) - dt). Braking at a keeps this true in the next
 * period, so a joint that starts inside never needs more than a.
 */
struct VISP_EXPORT vpJointBounds {
  vpJointVector lower;         //!< By position and velocity limits; <= 0 inside the position limits.
  vpJointVector upper;         //!< By position and velocity limits; >= 0 inside the position limits.
  vpJointVector velocityLimit; //!< By the velocity limits alone.
  vpJointVector
      roomBelow; //!< Way to the lower position limit, less the margin, rad or m; infinite for a continuous joint.
  vpJointVector roomAbove;         //!< The same to the upper one.
  vpJointVector accelerationLower; //!< Previous velocity - a dt.
  vpJointVector accelerationUpper; //!< Previous velocity + a dt.

  /*!
   * No allocation, no exception.
   * \param model : The arm.
   * \param q : Present configuration.
   * \param previous : Velocity commanded in the last period.
   * \param period : s, > 0.
   * \param margin : Kept from the position limits, rad or m, >= 0.
   * \return False when a number is missing, not finite or beyond vpArmLargest. The bounds then lead to rest: a joint whose
   * place is not known brakes, one whose velocity is not known counts as resting, and without period or margin all stop.
   */
  bool update(const vpArmModel &model, const vpJointVector &q, const vpJointVector &previous, double period,
              double margin) noexcept;
  /*!
   * Largest factor up to 1 with which a motion of all joints along \e direction (rad/s) can be braked before any
   * position limit without leaving that direction: the joint that brakes worst sets the deceleration of all. 0 for a
   * direction that is not finite.
   */
  [[nodiscard]] double together(const vpArmModel &model, const vpJointVector &direction, double period) const noexcept;
  /*!
   * The velocity nearest to \e wanted that is within all limits of joint \e i; the velocity limit goes first, then
   * acceleration, then position (they contradict each other only when a joint was brought to its limit by something
   * else). NaN counts as 0.
   */
  [[nodiscard]] double clamp(int i, double wanted) const noexcept;
};

END_VISP_NAMESPACE
#endif
