/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionForecast.h
 * \brief Where the product will be, along one axis.
 */
#ifndef vpMotionForecast_h
#define vpMotionForecast_h

#include <visp3/printing/vpPrintingLimits.h>
#include <visp3/trajectory/vpTrajectoryPlan.h>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief A present state carried into the future: along a planned motion if there is one, else at its acceleration for a
 * while and then at constant velocity.
 *
 * With a plan r(t) and the state (p, v) at the time t0, the motion is
 * p + r(t) - r(t0) + (v - r'(t0)) tau (1 - exp(-(t - t0) / tau)): the velocity error dies out as the controller makes
 * it.
 */
struct VISP_EXPORT vpMotionForecast {
  static constexpr int maxPieces = 4;    //!< Of a plan.
  static constexpr double longest = 1e6; //!< Nobody looks farther from #time, T.

  double time = 0.;             //!< t0, of the state below, T.
  double position = 0.;         //!< L.
  double velocity = 0.;         //!< L/T.
  double acceleration = 0.;     //!< Without a plan: L/T^2, from t0 on.
  double accelerationTime = 0.; //!< Without a plan: for so long, T, >= 0.
  double errorTime = 3.;        //!< With a plan: time in which a velocity error dies out, tau, T, > 0.
  int pieces = 0;               //!< Of the plan in use, 0 to maxPieces.
  std::array<vpTrajectorySegment, maxPieces> plan; //!< One after the other; their begins on the clock of \e time.

  /*!
   * True when all fields are in their ranges, the numbers and the plan's coefficients are finite and not beyond
   * vpPrintingLargest, and durations are not below its inverse. Only then the answers of at() are finite.
   */
  [[nodiscard]] bool isPlausible() const noexcept;
  /*!
   * Position, velocity, acceleration and jerk at any time; farther from #time than #longest: the state there, of NaN: that at
   * #time. Does not throw or allocate.
   */
  [[nodiscard]] vpAxisState at(double t) const noexcept;
};

/*!
 * \ingroup group_printing
 * \brief State of a sequence of polynomials, of durations > 0, at any time; outside of them it goes on at the velocity of
 * their end.
 */
[[nodiscard]] VISP_EXPORT vpAxisState vpEvaluatePieces(const vpTrajectorySegment *pieces, int count, double t) noexcept;

END_VISP_NAMESPACE
#endif
