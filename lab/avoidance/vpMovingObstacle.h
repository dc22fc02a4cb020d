/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpMovingObstacle_h
#define vpMovingObstacle_h

#include <visp3/avoidance/vpCollisionObject.h>

#include <limits>

BEGIN_VISP_NAMESPACE

/*!
 * \brief True motion of a simulated obstacle: straight on, or back and forth; it may appear and vanish.
 *
 * It does not rotate. Back and forth it moves at the object's velocity, reverses (at constant deceleration, within
 * #turnTime) around the time #turnAfter, and is back at its start at the time 2 #turnAfter.
 */
struct vpMovingObstacle {
  vpCollisionObject object;                                  //!< State (possibly before it appears) at time 0.
  double turnAfter = 0.;                                     //!< Time of reversal, s; 0: never; else > turnTime.
  double turnTime = 0.2;                                     //!< Duration of a reversal, s, > 0.
  double appears = 0.;                                       //!< Time of appearance, s, >= 0.
  double vanishes = std::numeric_limits<double>::infinity(); //!< Time from which it is absent, s, > appears.

  //! \throw vpException (badValue) naming the obstacle, the field that is out of range, and its value.
  void validate() const;
  //! Pose and velocity at time \e t, s; does not allocate.
  void stateAt(double t, vpRigidTransform &pose, vpTwist &velocity) const noexcept;
  //! True if it is present at time \e t, s.
  [[nodiscard]] bool isThere(double t) const noexcept { return t >= appears && t < vanishes; }
};

END_VISP_NAMESPACE
#endif
