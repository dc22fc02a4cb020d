/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanMotion.h
 * \brief The commanded motion of a law that plans: along a verified plan, which ends at rest, or braking.
 */
#ifndef vpPlanMotion_h
#define vpPlanMotion_h

#include "vpPlanSearch.h"

#include <visp3/trajectory/vpTwistShaper.h>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \brief The spline that is commanded: the interval of now, the pose at its first knot, and control points after it that are
 * decided already. Braking control points come from a vpTwistShaper, whose steps of a knot are within the limits by themselves.
 */
class vpPlanMotion
{
public:
  using Vector6 = vpTwistSpline::Vector6;
  using Pose = vpServoPose::Pose;
  static constexpr double h = vpTwistSpline::knot;

  //! \param limits : Of braking.
  explicit vpPlanMotion(const vpServoMotionLimits &limits) : m_brake(limits.shaperLimits()) {}

  bool isFollowing() const { return m_isFollowing; } //!< A plan; else braking, or at rest without a plan.
  const vpGazePlan &plan() const { return m_plan; }
  double planTime() const { return (m_index - 2 - m_queued + m_phase) * h; } //!< Of now, s.
  //! Of the plan after the decided control points, s.
  double left() const { return m_plan.duration() - (m_index - 1) * h; }
  //! At rest, and it stays there.
  bool isAtRest() const
  {
    return m_queued == 0 && m_spline.isAtRest() && (!m_isFollowing || (m_index - 1) * h >= m_plan.duration());
  }
  Vector6 twist() const { return m_spline.at(m_phase); }
  //! Where the commanded motion has led.
  Pose reference() const
  {
    return m_phase > 0. ? movedBy(m_knotPose, m_spline.mean(0., m_phase), m_phase * h) : m_knotPose;
  }

  //! Go on from this twist and rate at a knot.
  void restart(const Vector6 &twist, const Vector6 &rate, const Pose &pose)
  {
    m_spline.c0 = twist - 0.5 * h * rate;
    m_spline.c1 = twist + 0.5 * h * rate;
    brakeFrom(m_spline.c0, m_spline.c1);
    m_spline.c2 = generate();
    m_phase = 0.;
    m_knotPose = pose;
  }
  void brake() { brakeFrom(m_spline.c1, m_spline.c2); }
  //! At rest: the pose in another frame, or another one that the feedback is to keep.
  void rebase(const Pose &pose) { m_knotPose = pose; }
  //! Decides that many control points. \return The pose after them; fills way, before and last of the task.
  Pose decide(int points, vpPlanSearch::Task &task)
  {
    for (; m_queued < points; ++m_queued) {
      m_queue[place(m_queued)] = generate();
    }
    vpTwistSpline spline = m_spline;
    Pose pose = m_knotPose;
    task.way[0] = spline.c1;
    task.wayCount = 1;
    for (int i = 0; i <= m_queued; ++i) {
      pose = movedBy(pose, spline.mean(0., 1.), h);
      task.way[static_cast<std::size_t>(task.wayCount++)] = spline.c2;
      if (i < m_queued) {
        spline.push(m_queue[place(i)]);
      }
    }
    task.before = spline.c1;
    task.last = spline.c2;
    return pose;
  }
  //! Follow another plan, swapped, from the current knot on, which is at \e pose.
  void follow(vpGazePlan &plan, const Pose &pose)
  {
    std::swap(m_plan, plan);
    m_isFollowing = true;
    m_index = 1;
    m_knotPose = pose;
  }

  //! Time passes. \return True when a knot was passed: then arrive(), pushNext(), and again with 0.
  bool pass(double dt)
  {
    m_phase += dt / h;
    if (m_phase < 1. - 1e-9) {
      return false;
    }
    m_phase = std::max(m_phase - 1., 0.);
    m_knotPose = movedBy(m_knotPose, m_spline.mean(0., 1.), h);
    return true;
  }
  bool hasDecided() const { return m_queued > 0; }
  void pushNext()
  {
    if (m_queued == 0) {
      m_spline.push(generate());
      return;
    }
    m_spline.push(m_queue[place(0)]);
    m_first = (m_first + 1) % vpPlanSearch::maxDelay;
    --m_queued;
  }

private:
  static Pose movedBy(const Pose &pose, const Vector6 &twist, double dt)
  {
    return vpServoPose::moved(pose, twist.head<3>(), twist.tail<3>(), dt);
  }
  std::size_t place(int i) const { return static_cast<std::size_t>((m_first + i) % vpPlanSearch::maxDelay); }
  Vector6 generate()
  {
    return m_isFollowing ? m_plan.twist((m_index++ + 0.5) * h) : vpTwistSpline::fromTwist(m_brake.step(vpTwist(), h));
  }
  void brakeFrom(const Vector6 &before, const Vector6 &last)
  {
    m_brake.reset(vpTwistSpline::toTwist(last), vpTwistSpline::toTwist((last - before) / h));
    m_isFollowing = false;
    m_queued = 0;
  }

  vpTwistSpline m_spline;
  double m_phase = 0.; // fraction of the interval
  Pose m_knotPose;
  std::array<Vector6, vpPlanSearch::maxDelay> m_queue;
  int m_first = 0, m_queued = 0;
  bool m_isFollowing = false;
  vpTwistShaper m_brake;
  vpGazePlan m_plan;
  int m_index = 1; // of the next control point of m_plan
};

END_VISP_NAMESPACE
#endif
