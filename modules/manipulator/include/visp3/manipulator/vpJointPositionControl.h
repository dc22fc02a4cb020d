/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointPositionControl.h
 * \brief Joint torques from joint positions: PD with gravity.
 */
#ifndef vpJointPositionControl_h
#define vpJointPositionControl_h

#include <visp3/manipulator/vpJointFriction.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Gains of vpJointPositionControl, one of each a joint.
 */
struct VISP_EXPORT vpJointPositionControlSpec {
  vpJointVector kp;                //!< K_p, Nm/rad or N/m, >= 0.
  vpJointVector kd;                //!< K_d, Nm s/rad or N s/m, >= 0.
  vpJointVector maxTorque;         //!< Nm or N, > 0; infinity: none.
  bool compensateFriction = false; //!< Adds friction of the wanted velocity.
  vpJointFriction friction;        //!< Used when compensateFriction.

  /*!
   * \throw vpException (badValue) naming the field and the joint that are out of range, and the value.
   */
  void validate() const;
};

/*!
 * \class vpJointPositionControl
 * \ingroup group_manipulator
 * \brief tau = K_p (q_d - q) + K_d (q'_d - q') + g(q), thesis (3.19), and the friction and feedforward if wanted.
 * Without state.
 */
class VISP_EXPORT vpJointPositionControl
{
public:
  //! What a step is told; all of n numbers.
  struct Input {
    vpJointVector q;              //!< Measured, rad or m.
    vpJointVector velocity;       //!< Measured or estimated, rad/s or m/s.
    vpJointVector wantedQ;        //!< q_d.
    vpJointVector wantedVelocity; //!< q'_d.
    vpJointVector feedforward;    //!< g(q) of vpArmDynamics::gravity(), and M(q) q''_d + C q' if wanted, Nm or N.
  };
  //! What a step answers.
  struct Output {
    vpJointVector torque;       //!< Nm or N, within maxTorque.
    unsigned int saturated = 0; //!< Bit i: joint i is at its torque limit.
    bool valid = true; //!< False: an input was not finite, beyond vpArmLargest or of a wrong size; the torque is 0.
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
