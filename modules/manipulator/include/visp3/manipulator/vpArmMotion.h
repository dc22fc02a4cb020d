/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmMotion.h
 * \brief From what an arm is asked to do to the joint velocities of the next control period.
 */
#ifndef vpArmMotion_h
#define vpArmMotion_h

#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpJointBounds.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! What the arm is asked to do.
enum class vpArmTaskKind {
  Hold,          //!< Brake and stay.
  JointVelocity, //!< Given joint velocities.
  Twist,         //!< A twist in one of the frames.
  JointPath,     //!< To a configuration, by direct trajectory generation.
  PosePath       //!< To a pose of the end effector, by closed-loop kinematics.
};

//! \ingroup group_manipulator
//! Frames of a twist: those of vpArmFrame, and ViSP's MIXT_FRAME.
enum class vpArmTwistFrame { Base, EndEffector, Camera, Mixt };

/*!
 * \class vpArmMotion
 * \ingroup group_manipulator
 * \brief The step between a wish (hold, joint velocities, twist, configuration, pose) and joint velocities within the
 * limits of position, velocity and acceleration: what a robot driver calls once per control period.
 *
 * The wish may change at any time. Set a wish in the thread that calls step(), or lock both.
 * \code
 * vpArmMotion motion(model, vpRedundancySpec(), vpClosedLoopSpec());
 * motion.twist(law.step(measurement), vpArmTwistFrame::Camera);
 * velocity = motion.step(q, velocity); // every vpRedundancySpec::period; send it to the drives
 * \endcode
 */
class VISP_EXPORT vpArmMotion
{
public:
  /*!
   * \param model : Is referred to.
   * \param redundancy : Of twists, poses and all limits; its period is that of step().
   * \param closedLoop : Of poses.
   * \throw vpException (badValue) naming a joint without motion limits or a field of the spec.
   */
  vpArmMotion(const vpArmModel &model, const vpRedundancySpec &redundancy, const vpClosedLoopSpec &closedLoop);

  //! Brake and stay.
  void hold() { m_kind = vpArmTaskKind::Hold; }
  //! \param velocity : rad/s or m/s, one for each joint.
  void jointVelocity(const vpJointVector &velocity);
  //! \param twist : m/s and rad/s. \param frame : In which it is given.
  void twist(const vpTwist &twist, vpArmTwistFrame frame);
  /*!
   * \param goal : Configuration to stop at; cut to the position limits. \param q : Wanted now.
   * \param velocity : Commanded now. \param share : Of the velocity limits, (0, 1].
   */
  void jointPath(const vpJointVector &goal, const vpJointVector &q, const vpJointVector &velocity, double share);
  //! \param goal : Pose of the end effector in the base to stop at. \param q : Wanted now. \param velocity : Commanded now.
  void posePath(const vpRigidTransform &goal, const vpJointVector &q, const vpJointVector &velocity);
  //! Indices that the spare joints climb and axes that do not matter, in twist and pose motions.
  void setSelfMotion(const std::vector<vpSelfMotionIndex> &indices, const std::array<bool, 6> &free);

  /*!
   * Joint velocities of the next period; no allocation, no exception.
   * \param q : Wanted configuration now. \param velocity : Commanded in the last period.
   */
  const vpJointVector &step(const vpJointVector &q, const vpJointVector &velocity) noexcept;

  //! What is being done; Hold after a path has ended.
  [[nodiscard]] vpArmTaskKind kind() const { return m_kind; }
  //! A path has ended; it holds since.
  [[nodiscard]] bool finished() const { return m_finished; }
  //! A joint path could not be followed; pathSentence() says why.
  [[nodiscard]] bool failed() const { return m_failed; }
  //! Status of the joint path in a sentence.
  [[nodiscard]] std::string pathSentence() const { return m_pathOutput.status.message(); }
  //! Progress or end of the pose path.
  [[nodiscard]] vpClosedLoopStatus poseStatus() const { return m_closedState.status; }
  //! Of the last period, in twist and pose motions; Exact otherwise.
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
