/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpToolPath_h
#define vpToolPath_h

#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/trajectory/vpTrajectoryPlanner.h>

#include <Eigen/Core>

#include <array>

BEGIN_VISP_NAMESPACE

//! \brief Position, velocity and acceleration of the tool's origin in the base.
struct vpToolState {
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero(), a = Eigen::Vector3d::Zero();
};

//! \brief Task of the tool: through vias to a goal, at a speed.
struct vpToolTask {
  static constexpr int maxVias = 4;
  std::array<Eigen::Vector3d, maxVias> vias{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                            Eigen::Vector3d::Zero()};
  int viaCount = 0;
  Eigen::Vector3d goal = Eigen::Vector3d::Zero(), goalVelocity = Eigen::Vector3d::Zero();
  double speed = 1.; // fraction of the velocity limit

  [[nodiscard]] double length(const Eigen::Vector3d &from) const noexcept;
};

/*!
 * \class vpToolPath
 * \brief Direct trajectory generation (DTG) for the tool's origin: 5th order to the goal or one polynomial per segment
 * through vias, norms of velocity and acceleration bounded (thesis (8.3)-(8.9), corrected). plan() does not allocate.
 */
class vpToolPath
{
public:
  vpToolPath(double maxVelocity, double maxAcceleration);

  //! The fastest motion from \e from. Vias divide the time by the lengths of their segments. False: there is none.
  bool plan(const vpToolState &from, const vpToolTask &task, vpTrajectoryPlan &plan) noexcept;
  //! Brakes on a straight line. False as above.
  bool stop(const vpToolState &from, vpTrajectoryPlan &plan) noexcept;

  //! Stays at a position.
  static void hold(const Eigen::Vector3d &x, vpTrajectoryPlan &plan) noexcept;
  //! State on a plan at a time, s from its start.
  [[nodiscard]] static vpToolState at(const vpTrajectoryPlan &plan, double t) noexcept;
  //! An empty plan with capacity for any of these motions.
  [[nodiscard]] static vpTrajectoryPlan room() { return vpTrajectoryPlan(3, vpToolTask::maxVias); }

private:
  double m_maxVelocity, m_maxAcceleration;
  vpTrajectoryProblem m_problem;
  vpTrajectoryPlanner m_planner;
};

END_VISP_NAMESPACE
#endif
