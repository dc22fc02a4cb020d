/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointBounds.h
 * \brief Bounds of joint velocities for which the limits can still be kept later.
 */
#ifndef vpJointBounds_h
#define vpJointBounds_h

#include <visp3/manipulator/vpArmModel.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Velocity bounds of each joint for the next period, rad/s or m/s.
 *
 * A joint that moves for one period and then brakes at its acceleration limit must stop before its position limit:
 * v dt + v^2 / (2 a) <= room, so v <= a (sqrt(dt^2 + 2 room / a) - dt). Braking at a preserves this in the next
 * period, so a joint that starts inside never needs more than a.
 *
 * \code
 * vpJointBounds bounds;
 * if (!bounds.update(arm, q, velocity, 0.005, 0.)) { // velocity: the last one; period, s; margin, rad
 *   std::cerr << "invalid numbers: the bounds brake the arm" << std::endl;
 * }
 * for (int i = 0; i < arm.size(); ++i) {
 *   velocity(i) = bounds.clamp(i, wish(i)); // rad/s
 * }
 * send(velocity);
 * \endcode
 */
struct VISP_EXPORT vpJointBounds {
  vpJointVector lower;         //!< Lower bound from position and velocity limits; <= 0 inside the position limits.
  vpJointVector upper;         //!< Upper bound from position and velocity limits; >= 0 inside the position limits.
  vpJointVector velocityLimit; //!< Velocity limits alone.
  vpJointVector
      roomBelow; //!< Distance to the lower position limit minus the margin, rad or m; infinite for a continuous joint.
  vpJointVector roomAbove;         //!< Distance to the upper position limit minus the margin, likewise.
  vpJointVector accelerationLower; //!< Lower bound from acceleration: previous velocity - a dt.
  vpJointVector accelerationUpper; //!< Upper bound from acceleration: previous velocity + a dt.

  /*!
   * Computes the bounds; no allocation, no exception.
   * \param model : The arm.
   * \param q : Current configuration, rad or m.
   * \param previous : Velocities commanded in the last period, rad/s or m/s.
   * \param period : Control period, s, > 0.
   * \param margin : Distance kept from the position limits, rad or m, >= 0.
   * \return False if a number is missing, not finite or beyond vpArmLargest. The bounds then bring the arm to rest: a
   * joint of unknown position brakes, one of unknown velocity counts as resting, and without valid period or margin all
   * joints stop.
   */
  bool update(const vpArmModel &model, const vpJointVector &q, const vpJointVector &previous, double period,
              double margin) noexcept;
  /*!
   * Largest factor up to 1 at which a motion of all joints along \e direction (rad/s) can be braked before any position
   * limit without changing direction: the joint with the weakest braking sets the deceleration of all. 0 for a
   * direction that is not finite.
   */
  [[nodiscard]] double together(const vpArmModel &model, const vpJointVector &direction, double period) const noexcept;
  /*!
   * The velocity nearest to \e wanted within all limits of joint \e i; the velocity limit has priority, then
   * acceleration, then position (they conflict only if something else moved the joint to its limit). NaN counts as 0.
   */
  [[nodiscard]] double clamp(int i, double wanted) const noexcept;
};

END_VISP_NAMESPACE
#endif
