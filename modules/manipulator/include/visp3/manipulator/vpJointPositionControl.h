/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointPositionControl.h
 * \brief Joint position control: PD with gravity compensation.
 */
#ifndef vpJointPositionControl_h
#define vpJointPositionControl_h

#include <visp3/manipulator/vpJointFriction.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Gains of vpJointPositionControl, one per joint.
 */
struct VISP_EXPORT vpJointPositionControlSpec {
  vpJointVector kp;                //!< Position gain K_p, Nm/rad or N/m, >= 0.
  vpJointVector kd;                //!< Velocity gain K_d, Nm s/rad or N s/m, >= 0.
  vpJointVector maxTorque;         //!< Torque limit, Nm or N, > 0; infinity: none.
  bool compensateFriction = false; //!< Adds the friction at the desired velocity.
  vpJointFriction friction;        //!< Used if compensateFriction.

  /*!
   * \throw vpException (badValue) naming the field and the joint that are out of range, and the value.
   */
  void validate() const;
};

/*!
 * \class vpJointPositionControl
 * \ingroup group_manipulator
 * \brief PD control with gravity compensation tau = K_p (q_d - q) + K_d (q'_d - q') + g(q), thesis (3.19), with
 * optional friction and feedforward. Stateless.
 *
 * \code
 * vpJointPositionControlSpec spec;
 * spec.kp.setConstant(arm.size(), 500.); // Nm/rad
 * spec.kd.setConstant(arm.size(), 30.);  // Nm s/rad
 * spec.maxTorque = arm.torque();
 * const vpJointPositionControl control(spec);
 * vpArmDynamics dynamics(arm);
 * vpJointPositionControl::Input input;
 * input.q = encoders();
 * input.velocity = velocity;
 * input.wantedQ = q; // as commanded
 * input.wantedVelocity = vpJointVector::Zero(arm.size());
 * dynamics.gravity(input.q, input.feedforward);
 * vpJointPositionControl::Output output;
 * control.step(input, output);
 * send(output.torque); // 0 unless output.valid; output.saturated tells which joints are at their limits
 * \endcode
 */
class VISP_EXPORT vpJointPositionControl
{
public:
  //! Input of a step; n numbers each.
  struct Input {
    vpJointVector q;              //!< Measured configuration, rad or m.
    vpJointVector velocity;       //!< Measured or estimated velocities, rad/s or m/s.
    vpJointVector wantedQ;        //!< Desired configuration q_d, rad or m.
    vpJointVector wantedVelocity; //!< Desired velocities q'_d, rad/s or m/s.
    vpJointVector feedforward;    //!< g(q) by vpArmDynamics::gravity(), optionally M(q) q''_d + C q', Nm or N.
  };
  //! Output of a step.
  struct Output {
    vpJointVector torque;       //!< Torques, Nm or N, within maxTorque.
    unsigned int saturated = 0; //!< Bit i: joint i is at its torque limit.
    bool valid = true; //!< False: an input was not finite, beyond vpArmLargest or of the wrong size; the torque is 0.
  };

  //! \throw vpException (badValue), see vpJointPositionControlSpec::validate().
  explicit vpJointPositionControl(const vpJointPositionControlSpec &spec);
  //! One cycle; no allocation, no exception.
  void step(const Input &input, Output &output) const noexcept;

private:
  vpJointPositionControlSpec m_spec;
};

END_VISP_NAMESPACE
#endif
