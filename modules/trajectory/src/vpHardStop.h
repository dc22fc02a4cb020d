/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpHardStop.h
 * \brief The stop that leaves an interval of places least.
 */
#ifndef vpHardStop_h
#define vpHardStop_h

#include "vpAxisForms.h"

BEGIN_VISP_NAMESPACE

/*!
 * From a state to rest, as hard as is needed to stay between two places. If none is hard enough, the place that cannot
 * be kept is exceeded as little as can be without leaving the other.
 *
 * With a jerk limit J, to lose the deceleration before the rest costs way. So the velocity may pass through zero while
 * the axis still decelerates by b: it turns back, and stops then. For a given b no motion turns earlier than the fastest
 * change of velocity from the present state to u = -b^2/(2 J) with zero acceleration, because it decelerates most at
 * every velocity on its way. The greater b, the earlier the turn, and the longer the way back: from the turn to rest it
 * takes (1/3 + 1/sqrt(8)) b^3/J^2 = 0.687 b^3/J^2. So b is the least that is enough, or else the greatest for which there
 * is room, up to the acceleration limit and sqrt(2 J v_max), with which the velocity limit is just kept on the way back.
 *
 * What could better that: no way back is shorter than 2/3 b^3/J^2, which is that of a motion that turns again with the
 * same b, and then runs into the first place once more. It would allow a b that is 1 % greater. A second turn is taken
 * only where a start that decelerates too much to come to rest without turning would leave the other place.
 */
struct vpHardStop {
  //! The mildest stop that stays within \e low <= 0 <= \e high (places from the start), or leaves it least.
  vpHardStop(const vpAxisState &x, const vpAxisTask &task, double low, double high) noexcept;

  double acceleration = 0.;           //!< Largest acceleration.
  double jerk = 0.;                   //!< Largest jerk.
  int count = 1;                      //!< Number of velocities.
  std::array<double, 3> velocities{}; //!< One after the other reached with zero acceleration; the last is zero.

private:
  [[nodiscard]] double excess(const vpAxisState &x, double low, double high, double side) const noexcept;
  void turnBack(const vpAxisState &x, const vpAxisTask &task, double low, double high) noexcept;
};

END_VISP_NAMESPACE
#endif
