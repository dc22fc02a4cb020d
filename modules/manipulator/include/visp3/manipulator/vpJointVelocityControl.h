/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointVelocityControl.h
 * \brief Joint velocity control: PI.
 */
#ifndef vpJointVelocityControl_h
#define vpJointVelocityControl_h

#include <visp3/manipulator/vpJointFriction.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Gains of vpJointVelocityControl, one per joint.
 */
struct VISP_EXPORT vpJointVelocityControlSpec {
  double period = 0.001;           //!< Control period, s, > 0.
  vpJointVector kp;                //!< Proportional gain K_p, Nm s/rad or N s/m, >= 0.
  vpJointVector ki;                //!< Integral gain K_i, Nm/rad or N/m, >= 0.
  vpJointVector maxTorque;         //!< Torque limit, Nm or N, > 0; infinity: none.
  bool compensateFriction = false; //!< Adds the friction at the desired velocity.
  vpJointFriction friction;        //!< Used if compensateFriction.

  /*!
   * \throw vpException (badValue) naming the field and the joint that are out of range, and the value.
   */
  void validate() const;
};

/*!
 * \class vpJointVelocityControl
 * \ingroup group_manipulator
 * \brief PI control tau = K_p e' + K_i xi, xi' = e', thesis (3.20)-(3.21), e' the velocity error, with anti-windup: the
 * integral is frozen where the torque is at its limit and would grow further.
 *
 * \code
 * vpJointVelocityControlSpec spec;       // every 1 ms
 * spec.kp.setConstant(arm.size(), 30.);  // Nm s/rad
 * spec.ki.setConstant(arm.size(), 100.); // Nm/rad
 * spec.maxTorque = arm.torque();
 * vpJointVelocityControl control(spec);
 * vpArmDynamics dynamics(arm);
 * vpJointVelocityControl::Input input;
 * input.velocity = velocity;
 * input.wantedVelocity = wish;
 * dynamics.gravity(encoders(), input.feedforward);
 * vpJointVelocityControl::Output output;
 * control.step(input, output);
 * send(output.torque); // 0 unless output.valid; output.saturated tells which joints are at their limits
 * \endcode
 */
class VISP_EXPORT vpJointVelocityControl
{
public:
  //! Input of a step; n numbers each.
  struct Input {
    vpJointVector velocity;       //!< Measured or estimated velocities, rad/s or m/s.
    vpJointVector wantedVelocity; //!< Desired velocities q'_d, rad/s or m/s.
    vpJointVector feedforward;    //!< Gravity torques g(q), or zero, Nm or N.
  };
  //! Output of a step.
  struct Output {
    vpJointVector torque;       //!< Torques, Nm or N, within maxTorque.
    unsigned int saturated = 0; //!< Bit i: joint i is at its torque limit.
    bool valid = true; //!< False: an input was not finite, beyond vpArmLargest or of the wrong size; the torque is 0.
  };

  //! \throw vpException (badValue), see vpJointVelocityControlSpec::validate().
  explicit vpJointVelocityControl(const vpJointVelocityControlSpec &spec);
  //! Resets the integral to zero.
  void reset() noexcept;
  //! One cycle; no allocation, no exception.
  void step(const Input &input, Output &output) noexcept;
  //! Integral xi of the velocity error, rad or m.
  [[nodiscard]] const vpJointVector &integral() const noexcept { return m_integral; }

private:
  vpJointVelocityControlSpec m_spec;
  vpJointVector m_integral;
};

END_VISP_NAMESPACE
#endif
