/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmMotionCheck.h
 * \brief Tells a law that plans which camera motions an arm can execute.
 */
#ifndef vpArmMotionCheck_h
#define vpArmMotionCheck_h

#include <visp3/feedforward/vpServoMotionCheck.h>
#include <visp3/manipulator/vpRedundancySolver.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpArmMotionCheck
 * \ingroup group_servoing
 * \brief Executes planned twists on a copy of the arm, with the same redundancy resolution and limits as the arm
 * itself.
 *
 * The check and the arm have different periods, so a verified motion may be slowed a little where it is near an
 * acceleration limit; the joints' limits are kept by the arm's own solver in any case. No function allocates after
 * construction.
 *
 * \code
 * vpArmMotionCheck check(arm, vpRedundancySpec());
 * vpServoController controller = vpServoController::create("ff-dtg");
 * controller.setMotionCheck(&check);
 * // each cycle, q and velocity being what the joints were commanded:
 * check.setState(q, velocity);
 * const vpServoCommand command = controller.step(measurement, dt);
 * \endcode
 */
class VISP_EXPORT vpArmMotionCheck : public vpServoMotionCheck
{
public:
  /*!
   * \param model : The arm; referenced, must outlive this. \param spec : Parameters of its solver.
   * \param indices : Indices that self-motion maximizes; of more than vpMaxArmIndices the first.
   * \param free : Axes of the twists that are not commanded.
   * \param jerk : Limits of the joints' jerks, computed as differences of their accelerations at the control points of
   *   a plan, rad/s^3 or m/s^3; empty: none. A tenth of them is left for the difference of the periods. Self-motion
   *   jumps within the limits of acceleration: with \e indices no plan may be found.
   * \param frame : Frame of the twists: that of the camera, or that of the end effector before a fixed camera.
   * \throw vpException (badValue) naming the field of \e spec that is out of range, a joint without motion limits, or a
   *   limit of jerk that is not > 0, or their number.
   */
  vpArmMotionCheck(const vpArmModel &model, const vpRedundancySpec &spec,
                   const std::vector<vpSelfMotionIndex> &indices = {}, const std::array<bool, 6> &free = {},
                   const vpJointVector &jerk = {}, vpArmFrame frame = vpArmFrame::Camera);

  //! Where the arm is now: positions, rad or m, and commanded velocities, rad/s or m/s.
  void setState(const vpJointVector &q, const vpJointVector &velocity) noexcept;

  void begin() noexcept VP_OVERRIDE;
  /*!
   * \return 1 or less when the arm executes the twist; 1 / share when acceleration or velocity limits allow only a
   *   share of it, or the cube root of the excess over a limit of jerk; infinity when position limits or a singularity
   *   forbid it, and when the state is not finite.
   */
  [[nodiscard]] double add(const vpTwist &twist, double dt) noexcept VP_OVERRIDE;

private:
  double jerkExcess(double dt) noexcept;
  double armExcess() const noexcept;

  const vpArmModel *m_model;
  vpRedundancySpec m_spec;
  vpRedundancySolver m_solver;
  vpRedundancyInput m_input;
  vpRedundancyOutput m_output;
  vpArmData m_data;
  vpJointVector m_q, m_velocity; // now
  vpJointVector m_place;         // of the copy
  vpJointVector m_jerk;          // limits, or none
  vpJointVector m_acceleration;  // of the copy
  bool m_isAccelerationKnown = false;
};

END_VISP_NAMESPACE
#endif
