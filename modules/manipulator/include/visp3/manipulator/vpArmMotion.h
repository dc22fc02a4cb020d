/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmMotion.h
 * \brief Converts a requested arm motion to joint velocities for the next control period.
 */
#ifndef vpArmMotion_h
#define vpArmMotion_h

#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpJointBounds.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! Motion requested from the arm.
enum class vpArmTaskKind {
  Hold,          //!< Brake and hold the position.
  JointVelocity, //!< Follow given joint velocities.
  Twist,         //!< Follow a twist in one of the frames.
  JointPath,     //!< Move to a configuration, by direct trajectory generation (DTG).
  PosePath       //!< Move to an end-effector pose, by closed-loop kinematics.
};

//! \ingroup group_manipulator
//! Frames of a twist: those of vpArmFrame, and ViSP's MIXT_FRAME.
enum class vpArmTwistFrame { Base, EndEffector, Camera, Mixt };

/*!
 * \class vpArmMotion
 * \ingroup group_manipulator
 * \brief Converts a requested motion (hold, joint velocities, twist, configuration, pose) to joint velocities within
 * the position, velocity and acceleration limits. A robot driver calls step() once per control period.
 *
 * The request may change at any time. Set it in the thread that calls step(), or lock both.
 * \code
 * vpArmMotion motion(arm, vpRedundancySpec(), vpClosedLoopSpec());
 * vpJointVector velocity = vpJointVector::Zero(arm.size()); // rad/s
 * while (measurement.valid) {                               // every vpRedundancySpec::period, 5 ms
 *   motion.twist(law.step(measurement, motion.period()).v, vpArmTwistFrame::Camera);
 *   velocity = motion.step(q, velocity);
 *   q += motion.period() * velocity; // to the drives
 *   if (motion.solver().status == vpRedundancyStatus::BlockedByLimits) {
 *     std::cerr << motion.solver().message() << std::endl;
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpArmMotion
{
public:
  /*!
   * \param model : The arm; referenced, must outlive this object.
   * \param redundancy : Parameters for twists, poses and all limits; its period is that of step().
   * \param closedLoop : Parameters for pose motions.
   * \throw vpException (badValue) naming a joint without motion limits or an invalid field.
   */
  vpArmMotion(const vpArmModel &model, const vpRedundancySpec &redundancy, const vpClosedLoopSpec &closedLoop);

  //! Brake and hold the position.
  void hold() { m_kind = vpArmTaskKind::Hold; }
  //! Follow joint velocities. \param velocity : One per joint, rad/s or m/s.
  void jointVelocity(const vpJointVector &velocity);
  //! Follow a twist. \param twist : m/s and rad/s. \param frame : Frame of the twist.
  void twist(const vpTwist &twist, vpArmTwistFrame frame);
  /*!
   * Move to a configuration.
   * \param goal : Goal configuration; clamped to the position limits. \param q : Current commanded configuration.
   * \param velocity : Current commanded velocities. \param share : Fraction of the velocity limits to use, (0, 1].
   */
  void jointPath(const vpJointVector &goal, const vpJointVector &q, const vpJointVector &velocity, double share);
  //! Move to a pose. \param goal : Goal pose of the end effector in the base.
  //! \param q : Current commanded configuration. \param velocity : Current commanded velocities.
  void posePath(const vpRigidTransform &goal, const vpJointVector &q, const vpJointVector &velocity);
  //! Sets the indices that self-motion maximizes and the free axes, for twist and pose motions.
  void setSelfMotion(const std::vector<vpSelfMotionIndex> &indices, const std::array<bool, 6> &free);

  /*!
   * Joint velocities for the next period; no allocation, no exception.
   * \param q : Current commanded configuration. \param velocity : Velocities commanded in the last period.
   */
  const vpJointVector &step(const vpJointVector &q, const vpJointVector &velocity) noexcept;

  //! Current motion; Hold after a path has ended.
  [[nodiscard]] vpArmTaskKind kind() const { return m_kind; }
  //! True if the path has ended and the arm holds.
  [[nodiscard]] bool finished() const { return m_finished; }
  //! True if a joint path could not be followed; pathSentence() gives the reason.
  [[nodiscard]] bool failed() const { return m_failed; }
  //! Status of the joint path in a sentence.
  [[nodiscard]] std::string pathSentence() const { return m_pathOutput.status.message(); }
  //! Status of the pose path.
  [[nodiscard]] vpClosedLoopStatus poseStatus() const { return m_closedState.status; }
  //! Solver output of the last period, in twist and pose motions; Exact otherwise.
  [[nodiscard]] const vpRedundancyOutput &solver() const { return m_closed.solver; }
  //! Control period, s.
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
