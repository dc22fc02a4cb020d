/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpGoalJitter.h
 * \brief How far a measured goal goes to and fro, and how long a plan should last to be smooth in spite of it.
 */
#ifndef vpGoalJitter_h
#define vpGoalJitter_h

#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpGoalJitter
 * \ingroup group_trajectory
 * \brief Noise of a goal, told from the goals themselves: what vpReplanPolicy::KeepArrival takes its floor from.
 *
 * A surprise is how far a new goal is from where the old one, moving on with its velocity, would be. Noise makes surprises of
 * alternating sign, since it does not stay; a goal that was moved makes a single one. So the jitter of an axis is the smaller
 * one of two successive surprises of opposite signs: its largest value, which fades by a factor of e in #memory.
 *
 * Corrections of such a size, made anew at every goal with plans of duration T, take accelerations up to 10/sqrt(3) jitter / T^2
 * and jerks up to 60 jitter / T^3. floor() is #ease times the duration at which a correction would take the limits themselves.
 */
class VISP_EXPORT vpGoalJitter
{
public:
  static constexpr double memory = 1.; //!< s.
  static constexpr double ease = 2.;   //!< A correction takes 1 / ease^2 of the acceleration limit.

  /*!
   * While a goal is on its way, the time left of KeepArrival comes down so many times as fast as time goes by, besides by
   * itself: the date of a plan that was long for once must not keep the next ones long.
   */
  static constexpr double hurry = 5.;

  //! \param axes : Number of axes, >= 1.
  explicit vpGoalJitter(int axes);

  void reset() noexcept;                        //!< No goal was seen.
  void pass(double dt) noexcept;                //!< Time goes by, s.
  void see(int axis, double surprise) noexcept; //!< A new goal; NaN and infinity are not noise and are left out.
  [[nodiscard]] double level(int axis) const;   //!< Jitter of an axis, unit.
  //! Least duration of a plan within the limits of \e problem, s; 0 for a goal that does not jitter.
  [[nodiscard]] double floor(const vpTrajectoryProblem &problem) const noexcept;

private:
  struct Axis {
    double last = 0.;
    double level = 0.;
  };
  std::vector<Axis> m_axes;
};

END_VISP_NAMESPACE
#endif
