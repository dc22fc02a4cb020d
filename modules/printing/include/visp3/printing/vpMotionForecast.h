/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionForecast.h
 * \brief Predicted motion of the product along one axis.
 */
#ifndef vpMotionForecast_h
#define vpMotionForecast_h

#include <visp3/printing/vpPrintingLimits.h>
#include <visp3/trajectory/vpTrajectoryPlan.h>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief Extrapolation of a current state: along a planned motion if there is one, otherwise with its acceleration for
 * a limited time and then at constant velocity.
 *
 * With a plan r(t) and the state (p, v) at the time t0, the motion is
 * p + r(t) - r(t0) + (v - r'(t0)) tau (1 - exp(-(t - t0) / tau)): the velocity error decays as under the controller.
 *
 * \code
 * vpMotionForecast forecast;
 * forecast.time = 100.;    // frame
 * forecast.position = 48.; // px
 * forecast.velocity = 5.;  // px/frame
 * if (forecast.isPlausible()) {
 *   std::cout << forecast.at(103.)[0] << " px" << std::endl; // 63
 * }
 * \endcode
 */
struct VISP_EXPORT vpMotionForecast {
  static constexpr int maxPieces = 4;    //!< Maximum number of pieces of a plan.
  static constexpr double longest = 1e6; //!< Maximum extrapolation from #time, T.

  double time = 0.;             //!< t0, time of the state below, T.
  double position = 0.;         //!< Position at t0, L.
  double velocity = 0.;         //!< Velocity at t0, L/T.
  double acceleration = 0.;     //!< Without a plan: acceleration from t0 on, L/T^2.
  double accelerationTime = 0.; //!< Without a plan: duration of the acceleration, T, >= 0.
  double errorTime = 3.;        //!< With a plan: decay time constant tau of a velocity error, T, > 0.
  int pieces = 0;               //!< Number of pieces of the plan, 0 to maxPieces.
  std::array<vpTrajectorySegment, maxPieces> plan; //!< Pieces of the plan in sequence, on the clock of #time.

  /*!
   * True when all fields are in their ranges, the numbers and the plan's coefficients are finite and not beyond
   * vpPrintingLargest, and durations are not below its inverse. Only then are the results of at() finite.
   */
  [[nodiscard]] bool isPlausible() const noexcept;
  /*!
   * Position, velocity, acceleration and jerk at any time; farther from #time than #longest: the state there; for NaN:
   * the state at #time. Does not throw or allocate.
   */
  [[nodiscard]] vpAxisState at(double t) const noexcept;
};

/*!
 * \ingroup group_printing
 * \brief State of a sequence of polynomials, of durations > 0, at any time; outside, the end velocity continues.
 */
[[nodiscard]] VISP_EXPORT vpAxisState vpEvaluatePieces(const vpTrajectorySegment *pieces, int count, double t) noexcept;

END_VISP_NAMESPACE
#endif
