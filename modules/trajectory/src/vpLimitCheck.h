/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpLimitCheck.h
 * \brief Checks the limits of a finished plan from its segments, independently of the planner.
 */
#ifndef vpLimitCheck_h
#define vpLimitCheck_h

#include <visp3/trajectory/vpTrajectoryPlan.h>
#include <visp3/trajectory/vpTrajectoryProblem.h>

BEGIN_VISP_NAMESPACE

/*!
 * Compares the exact extrema of all segments of a plan, including those after the arrival, with all limits of a
 * problem. Cheap bounds first, so that extrema are computed only where a limit is near. Never allocates.
 */
class vpLimitCheck
{
public:
  static constexpr double precision = 1e-9; //!< Relative excess that counts as rounding.

  vpLimitCheck(const vpTrajectoryProblem &problem, const vpTrajectoryPlan &plan) noexcept
    : m_problem(problem), m_plan(plan)
  {}

  /*!
   * Status of the plan: Working, Braking or NoFeasibleDuration, with the largest excess.
   * \param groupBraking : Time until which groups that start outside their limits are returning, s.
   * \param brakingEnd : Receives the time from which everything that was outside at the start is inside, s.
   */
  [[nodiscard]] vpTrajectoryStatus judge(double groupBraking, double &brakingEnd) const noexcept;

private:
  enum class Wanted { All, Unexplained };
  struct Worst {
    double relative = precision;
    vpLimitExcess excess;
  };
  [[nodiscard]] vpLimitExcess worst(double from, Wanted wanted, bool groupsBrake) const noexcept;
  void checkAxis(int axis, double from, Wanted wanted, Worst &worst) const noexcept;
  void checkGroups(double from, Worst &worst) const noexcept;
  [[nodiscard]] bool startsOutside(int axis, vpTrajectoryLimit limit) const noexcept;
  [[nodiscard]] bool anyStartsOutside(int axis) const noexcept;
  [[nodiscard]] double excursionEnd(int axis, vpTrajectoryLimit limit) const noexcept;

  const vpTrajectoryProblem &m_problem;
  const vpTrajectoryPlan &m_plan;
};

END_VISP_NAMESPACE
#endif
