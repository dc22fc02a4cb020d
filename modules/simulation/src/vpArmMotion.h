/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What an arm is asked to do, and the joint velocities of the next control period that do it.
#ifndef vpArmMotion_h
#define vpArmMotion_h

#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpJointBounds.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! What the arm is asked to do.
enum class vpArmTaskKind {
  Hold,          //!< Brake and stay.
  JointVelocity, //!< Given joint velocities.
  Twist,         //!< A twist in one of the frames.
  JointPath,     //!< To a configuration, by direct trajectory generation.
  PosePath       //!< To a pose of the end effector, by closed-loop kinematics.
};

//! Frames of a twist: those of vpArmFrame, and ViSP's MIXT_FRAME.
enum class vpArmTwistFrame { Base, EndEffector, Camera, Mixt };

class vpArmMotion
{
public:
  /*!
   * \param model : Is referred to.
   * \throw vpException (badValue) naming a joint without motion limits or a field of the spec.
   */
  vpArmMotion(const vpArmModel &model, const vpRedundancySpec &redundancy, const vpClosedLoopSpec &closedLoop);

  void hold() { m_kind = vpArmTaskKind::Hold; }
  void jointVelocity(const vpJointVector &velocity);
  void twist(const vpTwist &twist, vpArmTwistFrame frame);
  //! \param q : Wanted now. \param velocity : Commanded now. \param share : Of the velocity limits, (0, 1].
  void jointPath(const vpJointVector &goal, const vpJointVector &q, const vpJointVector &velocity, double share);
  void posePath(const vpRigidTransform &goal, const vpJointVector &q, const vpJointVector &velocity);
  //! Indices that the spare joints climb and axes that do not matter, in twist and pose motions.
  void setSelfMotion(const std::vector<vpSelfMotionIndex> &indices, const std::array<bool, 6> &free);

  /*!
   * Joint velocities of the next period; no allocation, no exception.
   * \param q : Wanted configuration now. \param velocity : Commanded in the last period.
   */
  const vpJointVector &next(const vpJointVector &q, const vpJointVector &velocity) noexcept;

  [[nodiscard]] vpArmTaskKind kind() const { return m_kind; }
  //! A path has ended; it holds since.
  [[nodiscard]] bool finished() const { return m_finished; }
  //! A joint path could not be followed; pathSentence() says why.
  [[nodiscard]] bool failed() const { return m_failed; }
  [[nodiscard]] std::string pathSentence() const { return m_pathOutput.status.message(); }
  //! How the pose path stands or ended.
  [[nodiscard]] vpClosedLoopStatus poseStatus() const { return m_closedState.status; }
  //! Of the last period, in twist and pose motions; Exact otherwise.
  [[nodiscard]] const vpRedundancyOutput &solver() const { return m_closed.solver; }
  [[nodiscard]] double period() const { return m_solver.spec().period; }

private:
  void clamped(const vpJointVector &q, const vpJointVector &velocity, const vpJointVector &wanted) noexcept;
  void followTwist(const vpJointVector &q, const vpJointVector &velocity) noexcept;
  void followPath(const vpJointVector &q, const vpJointVector &velocity) noexcept;
  void followPose() noexcept;

  const vpArmModel *m_model;
  vpRedundancySolver m_solver;
  vpClosedLoopKinematics m_loop;
  vpArmData m_data;
  vpJointBounds m_bounds;
  vpRedundancyInput m_input;
  vpClosedLoopInput m_pose;
  vpClosedLoopState m_closedState;
  vpClosedLoopOutput m_closed;
  vpTrajectoryInput<Eigen::Dynamic> m_pathInput;
  vpTrajectoryOutput<Eigen::Dynamic> m_pathOutput;
  vpDirectTrajectory<Eigen::Dynamic> m_path;
  vpArmTaskKind m_kind = vpArmTaskKind::Hold;
  vpArmTwistFrame m_frame = vpArmTwistFrame::Camera;
  vpTwist m_twist;
  vpJointVector m_wanted, m_velocity;
  bool m_finished = true, m_failed = false;
};

END_VISP_NAMESPACE
#endif
