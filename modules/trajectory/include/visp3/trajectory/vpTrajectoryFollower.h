/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryFollower.h
 * \brief The control cycle: advance along the plan, replan at events, return the commanded state.
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
 * \brief DTG, direct trajectory generation (algorithm 6.2, corrected), with the number of axes known at run time only.
 *
 * vpDirectTrajectory is the typed form that users write. An event is any change of goal, limits, vias or options; the
 * new plan starts at the commanded state of the last cycle, never at a measured one, so the motion is C2 across events.
 *
 * **KeepArrival** is for goals that are measured repeatedly, with noise. The arrival time stays; a plan lasts at least
 * vpGoalJitter::floor(), which grows and decays with the measured noise. A goal that has changed since the motion began
 * and has a velocity is a moving object: the remaining time then decreases quickly to that minimum, and the plan aims
 * at the predicted position q + v floor, within the position limits. (A plan to q would always lag behind by its own
 * duration.) The plan of the first goal ends at the goal as given, as with the other policies.
 *
 * \code
 * vpTrajectoryProblem problem(2); // axes
 * for (int i = 0; i < problem.axes(); ++i) {
 *   problem.field(vpTrajectoryProblem::GoalQ)[i] = 0.3;          // rad
 *   problem.field(vpTrajectoryProblem::MaxVelocity)[i] = 1.;     // rad/s
 *   problem.field(vpTrajectoryProblem::MaxAcceleration)[i] = 5.; // rad/s^2
 * }
 * vpTrajectoryFollower follower(problem.axes());
 * vpTrajectoryStatus status;
 * do {
 *   status = follower.step(problem, 0.001);           // s; the problem may change at any cycle
 *   send(follower.state(0)[0], follower.state(1)[0]); // rad
 * } while (vpIsWorking(status.result));
 * std::cout << status.message() << std::endl; // at the goal, or what is wrong
 * \endcode
 */
class VISP_EXPORT vpTrajectoryFollower
{
public:
  /*!
   * \throw vpException (badValue) when \e axes < 1 or \e maxVias < 0.
   */
  explicit vpTrajectoryFollower(int axes, int maxVias = 0);

  //! One cycle of \e dt seconds, at most 1e9. Never throws, never allocates.
  vpTrajectoryStatus step(const vpTrajectoryProblem &problem, double dt) noexcept;
  //! One cycle with an input that could not be read: the motion continues, the result is \e fault.
  vpTrajectoryStatus advance(const vpTrajectoryStatus &fault, double dt) noexcept;
  //! The next step() starts from the problem's start state.
  void reset() noexcept { m_started = false; }

  [[nodiscard]] vpAxisState state(int axis) const noexcept { return m_plan.at(axis, m_clock); } //!< Commanded state.
  [[nodiscard]] const vpTrajectoryPlan &plan() const { return m_plan; }                         //!< Current plan.
  [[nodiscard]] const vpTrajectoryStatus &status() const { return m_status; }                   //!< Last status.
  [[nodiscard]] double clock() const { return m_clock; } //!< Time since the start of the current plan, s.
  [[nodiscard]] double remaining() const
  {
    return m_clock < m_plan.duration() ? m_plan.duration() - m_clock : 0.;
  }                                                          //!< Time to arrival, s.
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

  vpTrajectoryProblem m_task; // Current task, as given by the user
  vpTrajectoryProblem m_rest; // The part of m_task left when the plan began, from the commanded state
  vpTrajectoryPlanner m_planner;
  vpTrajectoryPlan m_plan;
  vpGoalJitter m_jitter;
  vpTrajectoryStatus m_status;
  vpTrajectoryStatus m_planStatus;
  double m_clock = 0.;       // Time since the plan began, s
  double m_sinceReplan = 0.; // Time since the last replan, s, for replanPeriod
  double m_arrival = 0.;     // FixedArrival: on m_clock
  double m_goalAge = 0.;     // Time since the goal was given, s
  double m_thesisT = 0.;
  double m_goalInterval = 0.; // Time between the last two goals if this event brought one, s
  bool m_goalMoves = false;   // The goal has changed since the motion began, and has a velocity
  bool m_thesisBusy = false;
  bool m_started = false;
  bool m_newPlan = false;
};

END_VISP_NAMESPACE
#endif
