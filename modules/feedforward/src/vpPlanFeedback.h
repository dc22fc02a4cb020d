/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanFeedback.h
 * \brief Leads the camera back to its planned motion, within what the plan leaves of the limits.
 */
#ifndef vpPlanFeedback_h
#define vpPlanFeedback_h

#include "vpServoCheck.h"
#include "vpTwistSpline.h"

#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/trajectory/vpTwistShaper.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Proportional feedback, with an integral on the rotation against friction, through a vpTwistShaper. Nothing here
 * allocates, and nothing throws after construction.
 *
 * What any plan leaves of the limits is \e rest; a plan that goes on as it was verified may leave more, \e room. The shaper
 * may use all of the room, and has to be back within the rest before another plan can follow: isSmall().
 */
class vpPlanFeedback
{
public:
  using Vector6 = vpTwistSpline::Vector6;
  //! A goal nearer than this, m and rad, is reached: stiction makes smaller corrections a limit cycle.
  static constexpr double zone = 0.002, zoneTurn = 0.006;

  //! Gain on the rotation error in units of vpServoGains::lambda and vpServoGains::rotation.
  static constexpr double angularGain = 4.;

  vpPlanFeedback(const vpServoGains &gains, const vpServoMotionLimits &rest);

  //! Other limits from the next step on. \param rest : Within the range of a vpTwistShaper.
  void setRest(const vpServoMotionLimits &rest) noexcept;
  //! The part of the command that is not the plan's is this one now. \param rate : Its derivative.
  void reset(const Vector6 &twist, const Vector6 &rate) noexcept;
  //! Lengths of an error in units of the zone, the larger one.
  static double size(double shift, double turn) { return std::max(shift / zone, turn / zoneTurn); }

  /*!
   * Twist to add to the plan's.
   * \param shift, turn : From the camera to where it should be, in its frame, m and rad. \param planned : Twist of the plan.
   * \param isAtRest : The plan has ended. \param room : What it leaves from two cycles ago until its end, at least the rest.
   * \param mustBeSmall : Another plan is wanted. \param dt : s.
   */
  Vector6 step(const Eigen::Vector3d &shift, const Eigen::Vector3d &turn, const Vector6 &planned, bool isAtRest,
               const vpTwistNorms &room, bool mustBeSmall, double dt) noexcept;
  //! Within the rest for two cycles at least, now and until the end of an acceleration.
  bool isSmall() const { return m_small >= 2; }

private:
  Vector6 wish(const Eigen::Vector3d &shift, const Eigen::Vector3d &turn, const vpTwistNorms &room, double dt) noexcept;
  bool isWithinRest() const;

  double m_linearGain, m_angularGain, m_integralGain, m_integralLimit;
  vpTwistNorms m_rest;
  vpTwistShaper m_shaper;
  Eigen::Vector3d m_integral = Eigen::Vector3d::Zero(); // rad/s
  bool m_settled = false;
  double m_outside = 0.; // time with an error beyond the zone in which the feedback stops, s
  int m_small = 2;       // cycles within the rest
};

END_VISP_NAMESPACE
#endif
