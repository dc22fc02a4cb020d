/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMinimumDuration.h
 * \brief The exact smallest duration for which a motion keeps its limits, or the proof that there is none.
 */
#ifndef vpMinimumDuration_h
#define vpMinimumDuration_h

#include <visp3/trajectory/vpMotionFamily.h>

#include <limits>

BEGIN_VISP_NAMESPACE

//! \ingroup group_trajectory
//! \brief Limits of one axis. Infinity means no limit.
struct VISP_EXPORT vpAxisLimits {
  double velocity = std::numeric_limits<double>::infinity();     //!< |v| <= velocity, unit/s, > 0.
  double acceleration = std::numeric_limits<double>::infinity(); //!< |a| <= acceleration, unit/s^2, > 0.
  double jerk = std::numeric_limits<double>::infinity();         //!< |j| <= jerk, unit/s^3, > 0.
  double minPosition = -std::numeric_limits<double>::infinity(); //!< Lowest position, relative to the motion's start.
  double maxPosition = std::numeric_limits<double>::infinity();  //!< Highest position, relative to the motion's start.
};

//! \ingroup group_trajectory
//! \brief Limits on the Euclidean norm over several axes, such as Cartesian speed. Infinity means no limit.
struct VISP_EXPORT vpNormLimits {
  double velocity = std::numeric_limits<double>::infinity();     //!< Norm of the velocities, unit/s, > 0.
  double acceleration = std::numeric_limits<double>::infinity(); //!< Norm of the accelerations, unit/s^2, > 0.
};

//! \ingroup group_trajectory
//! \brief Result of a search for a duration.
struct VISP_EXPORT vpDurationAnswer {
  //! How the search ended.
  enum class Kind {
    Found,      //!< #T is the smallest feasible duration that is not below the floor.
    Infeasible, //!< Proven: no duration at or above the floor is feasible.
    Undecided   //!< Iteration limit reached; every duration below #T is certified infeasible.
  };
  Kind kind = Kind::Undecided; //!< How the search ended.
  double T = 0.;               //!< Duration, s.
  int iterations = 0;          //!< Evaluations of the motion; at most vpMinimumDuration::maxIterations.
};

/*!
 * \ingroup group_trajectory
 * \brief The smallest T for which the motions of a vpMotionFamily keep their limits.
 *
 * At a fixed s the limit on a derivative of order d reads g(T) = +-d^d p/ds^d (s; T) - L T^d <= 0, a polynomial in T of
 * degree 2 or 3 (4 or 6 for a norm). Starting from a lower bound, the exact extrema over s at the current T are
 * computed; at each one that violates its limit, T jumps to the next root of *that extremum's own* g: every T before
 * the root violates the limit at that s, so nothing is skipped. The largest jump is taken, until no limit is violated
 * (Found) or some g has no root left (Infeasible, a proof). T grows from below and converges quadratically, in 4
 * iterations on average. The roots are those of g shifted to the current T, whose constant term is the violation
 * itself: a rounding tie cannot make the search jump to the far root. Peak velocity is not monotone in T and the
 * feasible set may consist of several intervals; both are handled. Replaces the iteration (6.6), see vpThesisDuration.
 *
 * Nothing here allocates or throws.
 *
 * \code
 * const vpAxisState from{}, to{0.5}; // at rest, m
 * vpAxisLimits limits;
 * limits.velocity = 0.5;    // m/s
 * limits.acceleration = 2.; // m/s^2
 * const vpDurationAnswer answer = vpMinimumDuration::solve(vpMotionFamily::pointToPoint(from, to, 3), limits,
 *                                                          vpMinimumDuration::lowerBound(from, to, limits));
 * if (answer.kind == vpDurationAnswer::Kind::Found) { // not Infeasible or Undecided
 *   std::cout << answer.T << " s" << std::endl;       // 1.875
 * }
 * \endcode
 */
namespace vpMinimumDuration
{
constexpr int maxIterations = 64;   //!< Maximum number of evaluations of one motion.
constexpr double tolerance = 2e-13; //!< Relative excess over a limit that counts as rounding.

/*!
 * One evaluation: \e T itself when the motion keeps its limits at T, otherwise a later duration with everything in
 * between certified infeasible; infinity when no later duration is feasible.
 */
[[nodiscard]] VISP_EXPORT double nextCandidate(const vpMotionFamily &motion, const vpAxisLimits &limits,
                                               double T) noexcept;

//! One evaluation of a norm over \e count motions that share their duration and their share().
[[nodiscard]] VISP_EXPORT double nextCandidate(const vpMotionFamily *const motions[], int count,
                                               const vpNormLimits &limits, double T) noexcept;

/*!
 * Smallest feasible duration of one motion.
 * \param motion, limits : The motion and its limits.
 * \param floor : Duration to start from, s, > 0; see lowerBound().
 */
[[nodiscard]] VISP_EXPORT vpDurationAnswer solve(const vpMotionFamily &motion, const vpAxisLimits &limits,
                                                 double floor) noexcept;

/*!
 * Lower bound on the duration of any motion between these states: max(|h|/v_max, |dv|/a_max, |da|/j_max), and at least
 * one millionth of v_max/a_max, where coefficients lose their digits.
 */
[[nodiscard]] VISP_EXPORT double lowerBound(const vpAxisState &from, const vpAxisState &to,
                                            const vpAxisLimits &limits) noexcept;

/*!
 * A lower bound later than \e T from the limits at three fixed instants: where a rest-to-rest motion is fastest and
 * where it accelerates most. Cheaper than nextCandidate(), because no extrema are computed.
 * \return \e T or later; infinity when no later duration is feasible.
 */
[[nodiscard]] VISP_EXPORT double raiseLowerBound(const vpMotionFamily &motion, const vpAxisLimits &limits,
                                                 double T) noexcept;

//! True when the motion of exactly this duration keeps its limits.
[[nodiscard]] inline bool isFeasible(const vpMotionFamily &motion, const vpAxisLimits &limits, double T) noexcept
{
  return nextCandidate(motion, limits, T) == T;
}
} // namespace vpMinimumDuration

END_VISP_NAMESPACE
#endif
