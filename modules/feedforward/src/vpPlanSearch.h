/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanSearch.h
 * \brief Finds a vpGazePlan whose every command is within the limits, a bounded piece of work each cycle.
 */
#ifndef vpPlanSearch_h
#define vpPlanSearch_h

#include "vpGazePlan.h"

#include <visp3/feedforward/vpServoMotionCheck.h>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \brief "Verify or keep": a candidate is evaluated at every control point that it would command, joined to the two
 * before it; where it exceeds a limit, its duration is stretched by the excess and it is evaluated again. A goal that is a little
 * elsewhere is tried first with the present plan and a correction, which need not be slower where the plan accelerates.
 */
class vpPlanSearch
{
public:
  using Vector6 = vpTwistSpline::Vector6;
  static constexpr int maxTries = 8, maxDelay = 40;
  enum class State { Idle, Busy, Found, Failed };
  //! What to plan.
  struct Task {
    vpGazePlan::Start start;          //!< At the knot where the plan begins, half way between the two control points.
    Vector6 before = Vector6::Zero(); //!< Control point before that knot, in #last the one after it.
    Vector6 last = Vector6::Zero();
    Eigen::Vector3d origin = Eigen::Vector3d::Zero(); //!< Of the object in the goal camera, m.
    double floor = 0.;                                //!< Least duration, s.
    bool gaze = true;
    bool isFresh = true;                   //!< Not a better plan to the goal of the present one.
    bool isAtRest = false;                 //!< The start: a plan with scaled limits is then the same motion, slower.
    std::array<Vector6, maxDelay + 2> way; //!< Control points from now until #last, for the robot's check.
    int wayCount = 0;
    //! Correct this plan, from its time #since on, s, when that keeps the limits; nullptr: make a new one.
    const vpGazePlan *base = nullptr;
    double since = 0.;
  };

  explicit vpPlanSearch(const vpServoMotionLimits &limits);

  //! For the next open().
  void setLimits(const vpServoMotionLimits &limits);
  void setCheck(vpServoMotionCheck *check) { m_check = check; }
  void open(const Task &task) noexcept;
  void close() { m_state = State::Idle; }
  //! The robot is a control point further on its way.
  void pass() { ++m_passed; }
  //! Work of at most \e budget evaluations of a twist, or one step where it takes more: a call of the planner.
  void work(int budget) noexcept;
  //! Evaluations that a plan of this duration takes, s.
  int effort(double duration) const;

  State state() const { return m_state; }
  vpGazePlan &found() { return m_plan; } //!< With State::Found; may be swapped.

private:
  // Costs in evaluations of a twist.
  static constexpr int setCost = 8, planCost = 20, checkCost = 4, coarse = 24, mostCalls = 12;
  // What to do next with a candidate.
  enum class Step { Set, Plan, Glance, Verify };
  int cost() const;
  bool advance() noexcept;
  const vpTwistExcess &limitExcess() const { return m_task.base ? m_excess : m_newExcess; }
  bool stretch(double excess) noexcept;
  void planAnew() noexcept;
  bool setNext() noexcept;
  bool finishCandidate() noexcept;
  bool planNext() noexcept;
  bool beginGlance() noexcept;
  bool glanceNext() noexcept;
  void beginVerification() noexcept;
  bool verifyNext() noexcept;

  vpServoMotionLimits m_limits, m_newLimits; // of all plans, of new ones
  vpTwistExcess m_excess, m_newExcess;
  vpServoMotionCheck *m_check = nullptr;
  Task m_task;
  vpGazePlan m_plan;
  State m_state = State::Idle;
  Step m_step = Step::Set;
  vpGazePlan::Part m_part = vpGazePlan::Position; // to be planned next
  double m_common = 0.;                           // duration of both parts so far, s
  int m_calls = 0, m_content = 0;                 // of the planner for this candidate; parts with that duration
  double m_floor = 0., m_worst = 0.;
  double m_join = 0.; // jerk of the join of the last candidate, as a share of its limit
  int m_tries = 0, m_index = 0, m_last = 0, m_passed = 0;
  Vector6 m_a = Vector6::Zero(), m_b = Vector6::Zero();
};

END_VISP_NAMESPACE
#endif
