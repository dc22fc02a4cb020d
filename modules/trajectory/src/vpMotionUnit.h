/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionUnit.h
 * \brief Axes that must share a form: a single axis, or a group under a limit on its norm.
 */
#ifndef vpMotionUnit_h
#define vpMotionUnit_h

#include "vpAxisForms.h"

#include <visp3/trajectory/vpTrajectoryOptions.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! One axis with all forms it may take.
struct vpMotionAxis {
  vpAxisTask task;
  vpFramedMotion direct, ramped, stopping;
  vpCruiseMotion cruise;
};

/*!
 * Finds, for its axes together, the smallest feasible duration that is not below a given one. The single polynomial is
 * preferred; the other forms are built when it has no feasible duration.
 */
class vpMotionUnit
{
public:
  //! Room for so many members.
  void reserve(int axes);
  //! No members, no norm.
  void clear() noexcept;
  void add(vpMotionAxis *axis) noexcept { m_members[static_cast<std::size_t>(m_count++)] = axis; }
  void setNorm(const vpNormLimits &norm) noexcept
  {
    m_norm = norm;
    m_hasNorm = true;
  }
  /*!
   * Build the forms for the tasks of the members.
   * \param allowCruise : The cruise form may replace the single polynomial when it is faster.
   */
  void prepare(bool allowCruise) noexcept;
  //! Smallest feasible duration >= T; remembers the form that takes it.
  [[nodiscard]] double next(double T) noexcept;

  [[nodiscard]] int count() const { return m_count; } //!< Number of members.
  [[nodiscard]] const vpMotionAxis *member(int i) const
  {
    return m_members[static_cast<std::size_t>(i)];
  }                                                                  //!< A member.
  [[nodiscard]] double brakingDuration() const { return m_braking; } //!< s; 0: the start is inside the limits.
  [[nodiscard]] vpTrajectoryForm form() const { return m_form; }     //!< Form of the last next().
  [[nodiscard]] int iterations() const { return m_iterations; }      //!< Most looks of one search since prepare().
  [[nodiscard]] bool hasDroppedPosition() const { return m_droppedPosition; } //!< Position limits cannot be kept.
  [[nodiscard]] bool hasDroppedGoalAcceleration() const
  {
    return m_droppedGoal;
  } //!< The goal's acceleration cannot be.
  //! Append the motion of \e member (its number here) to the track of an axis.
  void emit(vpTrajectoryPlan &plan, int member, int axis, double factor, double T) const noexcept;

private:
  using Form = vpFramedMotion vpMotionAxis::*;
  [[nodiscard]] double search(Form form, double T) noexcept;
  [[nodiscard]] double cruiseNext(double T) const noexcept;
  [[nodiscard]] double fallbackNext(double T) noexcept;
  [[nodiscard]] double stoppingNext(double T) noexcept;
  [[nodiscard]] bool isAtGoal(bool atRest) const noexcept;
  [[nodiscard]] bool breaksNorm() const noexcept;
  [[nodiscard]] double commonRamp(bool head) noexcept;
  [[nodiscard]] double commonStop(bool head) noexcept;
  void brake() noexcept;
  void buildDirect() noexcept;
  void buildFallback() noexcept;
  void buildStopping() noexcept;
  void stopHard() noexcept;
  [[nodiscard]] double normNext(const vpMotionFamily *families, double T) noexcept;

  std::vector<vpMotionAxis *> m_members;
  std::vector<vpMotionFamily> m_steps; // scratch: ramps and stops of all members
  std::vector<const vpMotionFamily *> m_families;
  int m_count = 0;
  vpNormLimits m_norm;
  bool m_hasNorm = false, m_allowCruise = false;
  bool m_fallbackReady = false, m_stoppingReady = false, m_stoppingUsable = false; // built when first needed
  bool m_droppedPosition = false, m_droppedGoal = false;
  double m_braking = 0.;
  int m_iterations = 0;
  vpTrajectoryForm m_form = vpTrajectoryForm::Direct;
};

END_VISP_NAMESPACE
#endif
