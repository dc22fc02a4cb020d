/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryFollower.h
 * \brief The control cycle: advance along the plan, replan at events, answer the commanded state.
 */
#ifndef vpTrajectoryFollower_h
#define vpTrajectoryFollower_h

#include <visp3/trajectory/vpGoalJitter.h>
#include <visp3/trajectory/vpThesisDuration.h>
#include <visp3/trajectory/vpTrajectoryPlanner.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpTrajectoryFollower
 * \ingroup group_trajectory
 * \brief Direct trajectory generation (algorithm 6.2, corrected) for a number of axes known at run time only.
 *
 * vpDirectTrajectory is the typed form that users write. An event is any change of goal, limits, vias or options; the
 * new plan starts at the commanded state of the last cycle, never at a measured one, so the motion is C2 across events.
 *
 * **KeepArrival** is for goals that are measured, with noise, again and again. The time of arrival stays; a plan lasts at least
 * vpGoalJitter::floor(), which grows and fades with the noise that is seen. A goal that has changed since the motion began, and
 * has a velocity, is an object on its way: there the time left comes down again quickly, to that floor, and the plan aims at
 * where the object will be then, q + v floor, within the position limits. (Aimed at q, the motion would lag behind by the
 * duration of its plans for ever.) The plan of the first goal ends at the goal as it was given, as with the other policies.
 */
class VISP_EXPORT vpTrajectoryFollower
{
public:
  /*!
   * \throw vpException (badValue) when \e axes < 1 or \e maxVias < 0.
   */
  explicit vpTrajectoryFollower(int axes, int maxVias = 0);

  //! One cycle of \e dt seconds, at most 1e9. Never throws, never allocates.
  vpTrajectoryStatus update(const vpTrajectoryProblem &problem, double dt) noexcept;
  //! One cycle with an input that could not even be read: the motion goes on, the answer is \e fault.
  vpTrajectoryStatus advance(const vpTrajectoryStatus &fault, double dt) noexcept;
  //! The next update() starts from the problem's start state.
  void reset() noexcept { m_started = false; }

  [[nodiscard]] vpAxisState state(int axis) const noexcept { return m_plan.at(axis, m_clock); } //!< Commanded state.
  [[nodiscard]] const vpTrajectoryPlan &plan() const { return m_plan; }                         //!< Plan in force.
  [[nodiscard]] const vpTrajectoryStatus &status() const { return m_status; }                   //!< Of the last cycle.
  [[nodiscard]] double clock() const { return m_clock; } //!< Since the plan in force began, s.
  [[nodiscard]] double remaining() const
  {
    return m_clock < m_plan.duration() ? m_plan.duration() - m_clock : 0.;
  }                                                          //!< s.
  [[nodiscard]] bool isNewPlan() const { return m_newPlan; } //!< The last cycle made a plan.

private:
  enum class Event { None, Task, Rate };
  [[nodiscard]] Event detect(const vpTrajectoryProblem &problem) const noexcept;
  void takeRest(const vpTrajectoryProblem &problem) noexcept;
  void noteGoal(const vpTrajectoryProblem &problem) noexcept;
  [[nodiscard]] double floorOf(const vpTrajectoryProblem &problem, Event event) noexcept;
  void aim() noexcept;
  [[nodiscard]] bool isSinglePolynomial() const noexcept;
  void replan(const vpTrajectoryProblem &problem, Event event) noexcept;
  void iterateThesis() noexcept;
  void tick(double dt) noexcept;
  [[nodiscard]] vpTrajectoryStatus currentStatus(bool arrivedBefore) const noexcept;

  vpTrajectoryProblem m_task; // in force, as the user gave it
  vpTrajectoryProblem m_rest; // what was left of it when the plan began, from the commanded state
  vpTrajectoryPlanner m_planner;
  vpTrajectoryPlan m_plan;
  vpGoalJitter m_jitter;
  vpTrajectoryStatus m_status;
  vpTrajectoryStatus m_planStatus;
  double m_clock = 0.;       // since the plan began
  double m_sinceReplan = 0.; // for the rate-based use
  double m_arrival = 0.;     // FixedArrival: on m_clock
  double m_goalAge = 0.;     // since the goal was given
  double m_thesisT = 0.;
  double m_goalInterval = 0.; // between the last two goals, if this event brought one
  bool m_goalMoves = false;   // it has changed since the motion began, and has a velocity
  bool m_thesisBusy = false;
  bool m_started = false;
  bool m_newPlan = false;
};

END_VISP_NAMESPACE
#endif
