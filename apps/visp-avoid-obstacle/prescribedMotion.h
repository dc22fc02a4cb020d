/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file prescribedMotion.h
 * \brief The tool of an arm on direct trajectories with goals and vias changing at given times: figures 8.8 and 8.10.
 */
#ifndef avoidObstacle_prescribedMotion_h
#define avoidObstacle_prescribedMotion_h

#include <visp3/avoidance/vpAvoidanceMethod.h>
#include <visp3/manipulator/vpRedundancySolver.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <optional>
#include <vector>

namespace avoidObstacle
{
//! \brief A change of the tool's goal.
struct ToolEvent {
  double time = 0.;                               //!< s.
  Eigen::Vector3d goal = Eigen::Vector3d::Zero(); //!< m.
  std::optional<Eigen::Vector3d> via;             //!< m.
};

/*!
 * \brief Repeats the events of the thesis at their times, without looking at obstacles. The position
 * of the tool is controlled, its orientation is free (thesis 8.1.1).
 */
class PrescribedMotion : public vpAvoidanceMethod
{
public:
  //! \param events : In time order; the first one starts the motion. \param scene : Must outlive this.
  PrescribedMotion(const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec, std::vector<ToolEvent> events,
                   double viaShare);

  vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) override;
  void setGoal(const vpAvoidanceGoal &) noexcept override {} // goals come from the events
  void look() override {}
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override;

private:
  void take(const ToolEvent &event) noexcept;

  const vpArmModel *m_arm;
  vpAvoidanceMethodSpec m_spec;
  std::vector<ToolEvent> m_events;
  double m_viaShare;
  vpRedundancySolver m_solver;
  vpDirectTrajectory<3> m_trajectory;
  vpTrajectoryInput<3> m_input;
  vpTrajectoryOutput<3> m_output;
  std::vector<vpTrajectoryVia<3>> m_via; // capacity for one
  vpRedundancyInput m_wish;
  vpRedundancyOutput m_solved;
  vpArmData m_data;
  std::size_t m_next = 0;
  long m_cycle = 0;
};
} // namespace avoidObstacle

#endif
