/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpThesisDuration.h
 * \brief The duration iteration of the thesis, (6.6) and algorithm 6.3, as a baseline.
 */
#ifndef vpThesisDuration_h
#define vpThesisDuration_h

#include <visp3/trajectory/vpMinimumDuration.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_trajectory
 * \brief T <- T + max(d_v (|v|_max - v_max), d_alpha (|a|_max - a_max)): the proportional iteration of the thesis.
 *
 * Corrected as follows: the peaks are the largest absolute values over all interior extrema and both ends (not the
 * latest root), and the duration can decrease as well as increase. With a fixed gain it needs 6 to 2600 iterations and
 * often does not converge, so the limits are not guaranteed. Kept for comparison with vpMinimumDuration.
 *
 * \code
 * const vpMotionFamily motion = vpMotionFamily::pointToPoint({}, {0.5}, 3); // m, from rest to rest
 * vpAxisLimits limits;
 * limits.velocity = 0.5;    // m/s
 * limits.acceleration = 2.; // m/s^2
 * const vpDurationAnswer answer = vpThesisDuration::solve(motion, limits, vpThesisDuration::Gains(), 1., 2600);
 * if (answer.kind == vpDurationAnswer::Kind::Found) { // often it is Undecided
 *   std::cout << answer.T << " s, " << answer.iterations << " iterations" << std::endl;
 * }
 * \endcode
 */
namespace vpThesisDuration
{
//! Gains of (6.6).
struct VISP_EXPORT Gains {
  double velocity = 0.5;     //!< d_v, s/(unit/s), > 0.
  double acceleration = 0.1; //!< d_alpha, s/(unit/s^2), > 0.
};

//! Extra time of (6.6) at duration \e T: positive when a limit is violated, negative when no limit is reached.
[[nodiscard]] VISP_EXPORT double extraTime(const vpMotionFamily &motion, const vpAxisLimits &limits, const Gains &gains,
                                           double T) noexcept;

/*!
 * Iterate from \e T until the extra time is below 1e-10 T, at most \e steps times.
 * \return Found, or Undecided with the T reached so far.
 */
[[nodiscard]] VISP_EXPORT vpDurationAnswer solve(const vpMotionFamily &motion, const vpAxisLimits &limits,
                                                 const Gains &gains, double T, int steps) noexcept;
} // namespace vpThesisDuration

END_VISP_NAMESPACE
#endif
