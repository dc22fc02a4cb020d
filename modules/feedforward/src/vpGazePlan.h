/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpGazePlan.h
 * \brief A planned camera motion to a goal: polynomials for the position and for what is left of the orientation.
 */
#ifndef vpGazePlan_h
#define vpGazePlan_h

#include "vpServoCheck.h"
#include "vpTwistSpline.h"

#include <visp3/trajectory/vpTrajectoryPlanner.h>

#include <algorithm>
#include <array>
#include <utility>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Motion of the camera in the frame of the goal camera: t(time) to 0 and R = R_la(t) exp(e(time)), e to 0, or
 * without gaze R = exp(e). Both are axes of a vpTrajectoryPlan.
 *
 * R_la is that of vpLookAt: while the camera translates, what remains of the image error is due to e. Nothing here
 * allocates or throws after construction.
 */
class vpGazePlan
{
public:
  using Vector6 = vpTwistSpline::Vector6;
  //! Camera at the start: pose in the frame of the goal camera, twist and its rate in the camera's own frame.
  struct Start {
    vpServoPose::Pose pose;
    Vector6 twist = Vector6::Zero(), rate = Vector6::Zero();
  };

  vpGazePlan();

  //! A problem for the next plans. \param origin : Of the object in the goal camera. \param gaze : Use R_la.
  //! \return False when the numbers allow no plan: R_la is not defined there.
  bool set(const Start &start, const Eigen::Vector3d &origin, bool gaze, const vpServoMotionLimits &limits) noexcept;
  //! Limits for a motion that is slower by \e factor.
  void slowDown(double factor) noexcept;
  //! The two plans: of the position, and of what is left of the orientation.
  enum Part { Position, Orientation };
  //! Limit the jerk of a part to less, by \e factor.
  void soften(Part part, double factor) noexcept;
  //! Plan a part with a duration of at least \e floor, s: half of the work. \return Its duration; NaN when there is no such plan.
  double plan(Part part, double floor) noexcept;

  /*!
   * Instead of a plan of its own: what is left of another one from its time \e since on, s, towards a goal that is a little elsewhere. A
   * quintic for each axis leads its difference from the start to 0 in \e duration, s. \return False when R_la is not defined there.
   */
  bool correct(const vpGazePlan &base, double since, const Start &start, double duration) noexcept;

  //! Camera twist at \e time, s from the start; zero after the end.
  Vector6 twist(double time) const noexcept;
  double duration() const { return std::max(planned() - m_since, m_correctionTime); } //!< s
  bool looksAtObject() const { return m_gaze; }                                       //!< R_la is used.

  /*! \name Largest norms of what is left of the motion */
  //! @{
  void forgetNorms() noexcept { m_norms.fill(vpTwistNorms::Zero()); }
  void noteNorms(double end, const vpTwistNorms &norms) noexcept; //!< \param end : Until when they have an effect, s.
  void finishNorms() noexcept;
  vpTwistNorms normsFrom(double time) const noexcept;
  //! @}

private:
  struct Rest {
    Eigen::Vector3d e, rate;
  };
  static constexpr int bins = 64;
  static constexpr double tail =
      5. * vpTwistSpline::knot; // s after the end, in which control points still have an effect
  std::size_t binOf(double time) const noexcept;
  Rest restAt(const Start &start, double time) const noexcept;
  using Axes = std::array<std::array<vpAxisState, 3>, 2>; // of both parts
  bool coordinates(const Start &start, Axes &axes) const noexcept;
  std::pair<double, double> at(Part part, int axis, double time) const noexcept;
  double planned() const { return std::max(m_plans[0].duration(), m_plans[1].duration()); }

  std::array<vpTrajectoryProblem, 2> m_problems;
  vpTrajectoryPlanner m_planner;
  std::array<vpTrajectoryPlan, 2> m_plans;
  double m_since = 0., m_correctionTime = 0.; // of the plans, at the start; no correction: 0, 0
  std::array<std::array<vpPolynomial, 3>, 2> m_corrections;
  Eigen::Vector3d m_origin = Eigen::Vector3d::Zero();
  bool m_gaze = true;
  std::array<vpTwistNorms, bins> m_norms;
};

END_VISP_NAMESPACE
#endif
