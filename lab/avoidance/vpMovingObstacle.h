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
 * \brief How an obstacle of a simulation truly moves: on for ever, or to and fro; it may come and go.
 *
 * It does not turn. To and fro it goes at the object's velocity, turns round (at constant deceleration, #turnTime for
 * all of it) about the time #turnAfter, and is back where it was at the time 2 #turnAfter.
 */
struct vpMovingObstacle {
  vpCollisionObject object;                                  //!< As it is (or would be) at the time 0.
  double turnAfter = 0.;                                     //!< s; 0: never turns round. Otherwise > turnTime.
  double turnTime = 0.2;                                     //!< From velocity to opposite velocity, s, > 0.
  double appears = 0.;                                       //!< s, >= 0: it is not there before.
  double vanishes = std::numeric_limits<double>::infinity(); //!< s, > appears: it is not there from then on.

  //! \throw vpException (badValue) naming the obstacle, the field that is out of range, and its value.
  void validate() const;
  //! Where it is at time \e t, s, and its velocity then; does not allocate.
  void stateAt(double t, vpRigidTransform &pose, vpTwist &velocity) const noexcept;
  //! True when it is there at time \e t, s.
  [[nodiscard]] bool isThere(double t) const noexcept { return t >= appears && t < vanishes; }
};

END_VISP_NAMESPACE
#endif
