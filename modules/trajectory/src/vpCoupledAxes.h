/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCoupledAxes.h
 * \brief Axes that must share a form: a single axis, or a group under a limit on its norm.
 */
#ifndef vpCoupledAxes_h
#define vpCoupledAxes_h

#include "vpAxisForms.h"

#include <visp3/trajectory/vpTrajectorySpec.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! One axis with all forms it may take.
struct vpMotionAxis {
  //! The forms that have one free polynomial.
  enum Form {
    Direct, // only the polynomial
    Ramped, // acceleration ramps around it
    Soft,   // a gentle stop, a polynomial from rest to rest, a gentle launch
    Hard,   // like Soft, as hard as needed
    FormCount
  };
  [[nodiscard]] vpFramedMotion &operator[](Form form) { return forms[static_cast<std::size_t>(form)]; }
  [[nodiscard]] const vpFramedMotion &operator[](Form form) const { return forms[static_cast<std::size_t>(form)]; }

  vpAxisTask task;
  std::array<vpFramedMotion, FormCount> forms;
  vpCruiseMotion cruise;
  double low = 0., high = 0.; // range of positions while it waits
  bool overshoots = false;    // the usual stop or launch leaves no room for a gentler one
};

/*!
 * Finds, for its axes together, the smallest feasible duration that is not below a given one. The single polynomial is
 * preferred; the other forms are tried when it has no feasible duration, or makes a detour: acceleration ramps around
 * it, a gentle stop and a polynomial from there, and last a stop as hard as needed.
 *
 * That last form has a solution for every duration above its own smallest, because a polynomial from rest to rest keeps
 * its limits however slow it is, and it leaves the range from start to goal by the braking distance only. No other form
 * may exceed the position limits if it does not: so a limit that cannot be kept is exceeded as little as possible. And
 * none may leave the range by more than the braking distance unless it is faster than stopping first: so no axis makes
 * a detour while it waits for the others.
 */
class vpCoupledAxes
{
public:
  //! Capacity for this many members.
  void reserve(int axes);
  //! Remove all members and the norm.
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
  //! Smallest feasible duration >= T; remembers its form.
  [[nodiscard]] double next(double T) noexcept;

  [[nodiscard]] double estimate() const { return m_estimate; } //!< Lower bound of the single polynomial's duration.
  [[nodiscard]] int count() const { return m_count; }          //!< Number of members.
  [[nodiscard]] const vpMotionAxis *member(int i) const
  {
    return m_members[static_cast<std::size_t>(i)];
  }                                                                  //!< A member.
  [[nodiscard]] bool hasNorm() const { return m_hasNorm; }           //!< True for a group with a norm limit.
  [[nodiscard]] double brakingDuration() const { return m_braking; } //!< s; 0: the start is inside the limits.
  [[nodiscard]] vpTrajectoryForm form() const { return m_form; }     //!< Form of the last next().
  [[nodiscard]] int iterations() const { return m_iterations; }      //!< Maximum evaluations per search so far.
  [[nodiscard]] bool hasDroppedGoalAcceleration() const { return m_droppedGoal; } //!< Goal acceleration unreachable.
  //! Append the motion of \e member (its number here) to the track of an axis.
  void emit(vpTrajectoryPlan &plan, int member, int axis, double factor, double T) const noexcept;

private:
  using Form = vpMotionAxis::Form;
  [[nodiscard]] vpMotionAxis &at(int i) const { return *m_members[static_cast<std::size_t>(i)]; }
  [[nodiscard]] bool isSingle() const { return m_count == 1 && !m_hasNorm; }
  [[nodiscard]] int order() const { return at(0).task.order; }
  [[nodiscard]] double search(Form form, double T) noexcept;
  [[nodiscard]] double searchFree(double T) noexcept;
  [[nodiscard]] double searchRamped(double T) noexcept;
  [[nodiscard]] double searchSoft(double T, double instead) noexcept;
  [[nodiscard]] double searchStops(double T, double instead) noexcept;
  [[nodiscard]] double searchLast(double T) noexcept;
  [[nodiscard]] bool makesDetour(double T) const noexcept;
  [[nodiscard]] bool isAtGoal(bool atRest) const noexcept;
  [[nodiscard]] bool breaksNorm() const noexcept;
  [[nodiscard]] bool keepsPositions(Form form) const noexcept;
  [[nodiscard]] bool isOutside() const noexcept;
  [[nodiscard]] bool mayBeSoft() const noexcept;
  [[nodiscard]] double commonRamp(bool head) noexcept;
  [[nodiscard]] double commonStop(bool head) noexcept;
  [[nodiscard]] double commonDuration(double T) noexcept;
  void dropGoalAcceleration() noexcept;
  void brake() noexcept;
  void buildRamped() noexcept;
  void buildSoft() noexcept;
  void buildSmooth() noexcept;
  void buildStop(Form form, double hardness) noexcept;
  void buildLast() noexcept;
  void buildHardStop() noexcept;
  void comeBack() noexcept;
  void boundPositions() noexcept;
  bool takeLast() noexcept;
  void close(Form form) noexcept;
  [[nodiscard]] double leastCruise() const noexcept;
  void openCruise() noexcept;
  [[nodiscard]] double commonStep(bool head, double rest, double up, double down) noexcept;
  [[nodiscard]] double searchCruise(double T) noexcept;
  [[nodiscard]] double normNext(const vpMotionFamily *families, double T) noexcept;

  std::vector<vpMotionAxis *> m_members;
  std::vector<vpMotionFamily> m_steps; // scratch: ramps and stops of all members
  std::vector<const vpMotionFamily *> m_families;
  int m_count = 0;
  vpNormLimits m_norm;
  bool m_hasNorm = false, m_allowCruise = false, m_droppedGoal = false;
  bool m_rampedReady = false, m_softReady = false, m_lastBuilt = false, m_lastReady = false, m_cruiseReady = false;
  bool m_roomier = false;           // the last resort widened a range or a position limit
  bool m_bounded = false;           // not a rest-to-rest move, which never leaves the range from start to goal
  Form m_last = vpMotionAxis::Hard; // has a solution for every duration
  Form m_used = vpMotionAxis::Direct;
  std::array<double, vpMotionAxis::FormCount> m_none{}; // a form is known to be infeasible from this duration on
  double m_braking = 0., m_headRamp = 0., m_tailRamp = 0.;
  double m_estimate = 0.;
  double m_own = 0.; // longer than this, a start outside its position limits comes back before anything else
  int m_iterations = 0;
  vpTrajectoryForm m_form = vpTrajectoryForm::Direct;
};

END_VISP_NAMESPACE
#endif
