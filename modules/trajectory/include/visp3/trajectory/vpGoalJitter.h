/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpGoalJitter.h
 * \brief Estimates the noise of a measured goal, and the plan duration needed for smooth motion in spite of it.
 */
#ifndef vpGoalJitter_h
#define vpGoalJitter_h

#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpGoalJitter
 * \ingroup group_trajectory
 * \brief Noise of a goal, estimated from the goals themselves; gives vpReplanPolicy::KeepArrival its minimum duration.
 *
 * A surprise is the distance of a new goal from the old one extrapolated with its velocity. Noise makes surprises of
 * alternating sign; a goal that was moved makes a single one. So the jitter of an axis is the smaller of two successive
 * surprises of opposite signs: its largest value, which decays by a factor of e in #memory.
 *
 * Corrections of this size, made at every new goal with plans of duration T, need accelerations up to
 * 10/sqrt(3) jitter / T^2 and jerks up to 60 jitter / T^3. floor() is #ease times the duration at which a correction
 * would reach the limits.
 *
 * \code
 * vpTrajectoryProblem problem(1); // axes
 * problem.field(vpTrajectoryProblem::MaxAcceleration)[0] = 2.; // m/s^2
 * vpGoalJitter jitter(1);
 * for (int i = 0; i < 50; ++i) {
 *   jitter.pass(0.04);                          // s
 *   jitter.see(0, i % 2 == 0 ? 0.001 : -0.001); // new goal minus the expected one, m
 * }
 * std::cout << "noise of " << jitter.level(0) << " m, plans of " << jitter.floor(problem) << " s" << std::endl;
 * \endcode
 */
class VISP_EXPORT vpGoalJitter
{
public:
  static constexpr double memory = 1.; //!< Decay time constant of the jitter, s.
  static constexpr double ease = 2.;   //!< Duration factor: a correction takes 1 / ease^2 of the acceleration limit.

  /*!
   * While a goal is moving, the remaining time of KeepArrival also decreases by this many times the elapsed time: one
   * long plan must not keep the following ones long.
   */
  static constexpr double hurry = 5.;

  //! \param axes : Number of axes, >= 1.
  explicit vpGoalJitter(int axes);

  void reset() noexcept;                        //!< Forget all goals.
  void pass(double dt) noexcept;                //!< Advance the time by dt, s.
  void see(int axis, double surprise) noexcept; //!< Add the surprise of a new goal; NaN and infinity are ignored.
  [[nodiscard]] double level(int axis) const;   //!< Jitter of an axis, unit.
  //! Minimum duration of a plan within the limits of \e problem, s; 0 for a goal without jitter.
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
