/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpClosedLoopKinematics.h
 * \brief Closed-loop inverse kinematics: joint positions from a desired end-effector pose, with pose feedback.
 */
#ifndef vpClosedLoopKinematics_h
#define vpClosedLoopKinematics_h

#include <visp3/manipulator/vpRedundancySolver.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Parameters of vpClosedLoopKinematics; those of the solver are in vpRedundancySpec.
 */
struct VISP_EXPORT vpClosedLoopSpec {
  double gain = 5.;               //!< Gain K_k of (3.16), 1/s, > 0 and at most 1/period.
  double maxLinear = 0.5;         //!< Largest commanded linear velocity of the end effector, m/s, > 0.
  double maxAngular = 1.;         //!< Largest commanded angular velocity, rad/s, > 0.
  double linearTolerance = 1e-5;  //!< Position tolerance at the goal, m, > 0.
  double angularTolerance = 1e-5; //!< Orientation tolerance at the goal, rad, > 0.
  //! Self-motion is slowed if it moves the tool by more than this in a period, m (rad), > 0.
  double driftTolerance = 2e-7;
  double stallTime = 2.; //!< The motion is aborted after this time without progress, s, > 0.

  /*!
   * \param period : Period of the solver, s.
   * \throw vpException (badValue) naming the field that is out of range, and its value.
   */
  void validate(double period) const;
};

//! \ingroup group_manipulator
//! \brief Status of the motion to the goal.
enum class vpClosedLoopStatus {
  Moving,               //!< Moving to the goal.
  Reached,              //!< At the goal, within the tolerances; the self-motion continues.
  StoppedByLimits,      //!< Aborted: joints at their limits, the arm cannot get closer to the goal.
  StoppedBySingularity, //!< Aborted: the goal lies beyond a singularity or outside the workspace.
  //! Aborted: the arm has too few joints for all axes of the goal, see vpRedundancyOutput::unreachableAxes.
  StoppedByAxis,
  Stalled, //!< Aborted without progress for another reason.
  //! An input was not finite, beyond vpArmLargest, of the wrong size or not a rotation; the arm brakes. If the
  //! configuration itself is invalid the status is permanent: start with a new one.
  InvalidInput
};

/*!
 * \ingroup group_manipulator
 * \brief Input of a step: current goal.
 */
struct VISP_EXPORT vpClosedLoopInput {
  vpRigidTransform goal;      //!< Goal pose fMe of the end effector now.
  vpTwist twist;              //!< Feedforward x'_d: velocity of the goal, axes of the base, m/s and rad/s.
  std::array<bool, 6> free{}; //!< Free components (not controlled), in the end effector's frame.
  std::array<vpSelfMotionIndex, vpMaxArmIndices> indices; //!< Self-motion indices, see vpRedundancyInput.
  int indexCount = 0;                                     //!< Number of indices used.
};

/*!
 * \ingroup group_manipulator
 * \brief Commanded configuration and the state for the next step; to start, set #q and leave the rest at its defaults.
 */
struct VISP_EXPORT vpClosedLoopState {
  vpJointVector q;                                        //!< Commanded configuration, rad or m.
  vpJointVector velocity;                                 //!< Commanded velocity; empty: at rest.
  double selfMotionShare = 1.;                            //!< Factor on the self-motion in the last step, 0..1.
  double best = -1.;                                      //!< Smallest error since the goal was set, m; < 0: none yet.
  double waiting = 0.;                                    //!< Time since #best last decreased, s.
  vpRigidTransform goal;                                  //!< Goal of the last step.
  vpClosedLoopStatus status = vpClosedLoopStatus::Moving; //!< Status of the last step.
};

/*!
 * \ingroup group_manipulator
 * \brief Output of a step besides the new state.
 */
struct VISP_EXPORT vpClosedLoopOutput {
  vpClosedLoopStatus status = vpClosedLoopStatus::Moving; //!< Status of the motion.
  //! Pose error before the step, axes of the end effector: m, then rad.
  Eigen::Matrix<double, 6, 1> error = Eigen::Matrix<double, 6, 1>::Zero();
  vpRedundancyOutput solver; //!< Solver output of the step.

  //! Status as a readable sentence.
  [[nodiscard]] const char *message() const noexcept;
};

/*!
 * \class vpClosedLoopKinematics
 * \ingroup group_manipulator
 * \brief Closed-loop inverse kinematics (3.16)-(3.18), corrected: q(k+1) = q(k) + dt J^# (x'_d + K e) with the
 * geometric Jacobian, so that the orientation error is log(R_d R^T); J^# because the arm is redundant.
 *
 * An Euler step makes the tool drift with the square of the joint step. Each step is therefore predicted and its drift
 * compensated in advance; self-motion whose drift cannot be compensated, near a singularity, is slowed down. step()
 * does not allocate.
 *
 * \code
 * vpArmData data;
 * vpArmKinematics::forward(arm, q, data);
 * vpClosedLoopKinematics loop(arm);
 * vpClosedLoopState state;
 * state.q = q;
 * vpClosedLoopInput input;
 * input.goal = data.tool;
 * input.goal.p.z() -= 0.05; // m
 * vpClosedLoopOutput output;
 * do {
 *   loop.step(input, state, output); // every 5 ms
 *   send(state.q);
 * } while (output.status == vpClosedLoopStatus::Moving);
 * std::cout << output.message() << std::endl; // reached, or what stopped it
 * \endcode
 */
class VISP_EXPORT vpClosedLoopKinematics
{
public:
  /*!
   * \param model : The arm; referenced, must outlive the object.
   * \param redundancy : Parameters of the internal solver.
   * \param spec : Parameters of the motion to the goal.
   * \throw vpException (badValue) naming the invalid field or joint.
   */
  explicit vpClosedLoopKinematics(const vpArmModel &model, const vpRedundancySpec &redundancy = {},
                                  const vpClosedLoopSpec &spec = {});

  //! One period: \e state becomes the configuration to command at its end.
  void step(const vpClosedLoopInput &input, vpClosedLoopState &state, vpClosedLoopOutput &output) noexcept;
  //! The redundancy solver.
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
