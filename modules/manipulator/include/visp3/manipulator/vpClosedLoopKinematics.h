/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpClosedLoopKinematics.h
 * \brief From a wanted pose of the end effector to joint positions, with feedback on the pose.
 */
#ifndef vpClosedLoopKinematics_h
#define vpClosedLoopKinematics_h

#include <visp3/manipulator/vpRedundancySolver.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Parameters of vpClosedLoopKinematics; the solver's are in vpRedundancySpec.
 */
struct VISP_EXPORT vpClosedLoopSpec {
  double gain = 5.;               //!< K_k of (3.16), 1/s, > 0 and at most 1/period.
  double maxLinear = 0.5;         //!< Largest commanded linear velocity of the end effector, m/s, > 0.
  double maxAngular = 1.;         //!< Largest commanded angular velocity, rad/s, > 0.
  double linearTolerance = 1e-5;  //!< The goal is reached within this, m, > 0.
  double angularTolerance = 1e-5; //!< And this, rad, > 0.
  //! Self-motion that moves the tool by more than this in a period is made slower, m (rad), > 0.
  double driftTolerance = 2e-7;
  double stallTime = 2.; //!< Without progress for so long the motion is given up, s, > 0.

  /*!
   * \param period : Of the solver, s.
   * \throw vpException (badValue) naming the field that is out of range, and its value.
   */
  void validate(double period) const;
};

//! \ingroup group_manipulator
//! \brief Where the motion to the goal stands.
enum class vpClosedLoopStatus {
  Moving,               //!< On the way.
  Reached,              //!< At the goal, within the tolerances; the self-motion goes on.
  StoppedByLimits,      //!< Given up: joints at their limits leave no way nearer to the goal.
  StoppedBySingularity, //!< Given up: the goal lies beyond a singularity or outside the workspace.
  Stalled,              //!< Given up without progress for another reason.
  //! Something was not finite, beyond vpArmLargest, no rotation or of a wrong size; the arm brakes. When the configuration itself
  //! is broken it stays so: start with a new one.
  InvalidInput
};

/*!
 * \ingroup group_manipulator
 * \brief What is wanted now.
 */
struct VISP_EXPORT vpClosedLoopInput {
  vpRigidTransform goal;      //!< fMe wanted now.
  vpTwist twist;              //!< Feedforward x'_d: velocity of the goal, axes of the base, m/s and rad/s.
  std::array<bool, 6> free{}; //!< Components in the end effector's frame that do not matter.
  std::array<vpSelfMotionIndex, vpMaxArmIndices> indices; //!< See vpRedundancyInput.
  int indexCount = 0;                                     //!< How many of them count.
};

/*!
 * \ingroup group_manipulator
 * \brief The configuration that is commanded, and what the next step needs; start with a configuration and all else as
 * it is.
 */
struct VISP_EXPORT vpClosedLoopState {
  vpJointVector q;                                        //!< Commanded configuration, rad or m.
  vpJointVector velocity;                                 //!< Commanded velocity; empty: at rest.
  double selfMotionShare = 1.;                            //!< Of the last step, 0..1.
  double best = -1.;                                      //!< Smallest error since the goal came, m; < 0: none yet.
  double waiting = 0.;                                    //!< Time since it became smaller, s.
  vpRigidTransform goal;                                  //!< Of the last step.
  vpClosedLoopStatus status = vpClosedLoopStatus::Moving; //!< Of the last step.
};

/*!
 * \ingroup group_manipulator
 * \brief What a step answers besides the new state.
 */
struct VISP_EXPORT vpClosedLoopOutput {
  vpClosedLoopStatus status = vpClosedLoopStatus::Moving; //!< Where the motion stands.
  //! Before the step, end effector's axes: m, then rad.
  Eigen::Matrix<double, 6, 1> error = Eigen::Matrix<double, 6, 1>::Zero();
  vpRedundancyOutput solver; //!< Of the step.

  //! The status as a sentence for a person.
  [[nodiscard]] const char *sentence() const noexcept;
};

/*!
 * \class vpClosedLoopKinematics
 * \ingroup group_manipulator
 * \brief (3.16)-(3.18), corrected: q(k+1) = q(k) + dt J^# (x'_d + K e) with the geometric Jacobian, so that the
 * orientation error is log(R_d R^T); J^# because the arm is redundant.
 *
 * Euler's step moves the tool by the square of the joint step. Each step is therefore predicted, and what it would
 * drift is taken back in advance; self-motion whose drift cannot be taken back, near a singularity, is slowed down. No
 * allocation in step().
 */
class VISP_EXPORT vpClosedLoopKinematics
{
public:
  /*!
   * \param model : Is referred to; must outlive the object.
   * \param redundancy : Of the solver within.
   * \param spec : Of the motion to the goal.
   * \throw vpException (badValue) naming the field or joint that does not do.
   */
  explicit vpClosedLoopKinematics(const vpArmModel &model, const vpRedundancySpec &redundancy = {},
                                  const vpClosedLoopSpec &spec = {});

  //! One period: \e state becomes the configuration to command at its end.
  void step(const vpClosedLoopInput &input, vpClosedLoopState &state, vpClosedLoopOutput &output) noexcept;
  //! Solver that is used.
  [[nodiscard]] const vpRedundancySolver &solver() const noexcept { return m_solver; }

private:
  void drift(const vpJointVector &velocity, Eigen::Matrix<double, 6, 1> &twist) noexcept;
  [[nodiscard]] bool usable(const vpClosedLoopInput &input, const vpClosedLoopState &state) const noexcept;
  void brake(vpClosedLoopState &state, vpClosedLoopOutput &output) noexcept;
  [[nodiscard]] Eigen::Matrix<double, 6, 1> rate(const vpJointVector &velocity) const noexcept;
  void motion(const vpClosedLoopInput &input, vpClosedLoopState &state, vpClosedLoopOutput &output) noexcept;

  const vpArmModel *m_model;
  vpClosedLoopSpec m_spec;
  vpRedundancySolver m_solver;
  vpArmData m_data, m_ahead;
  vpRedundancyInput m_input;
};

END_VISP_NAMESPACE
#endif
