/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointFriction.h
 * \brief Joint friction and its compensation torque.
 */
#ifndef vpJointFriction_h
#define vpJointFriction_h

#include <visp3/manipulator/vpArmModel.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Joint friction F_f = Fv q' + Fc sgn(q'), thesis (3.2)-(3.3), with sgn replaced by tanh(q' / smoothing). Use
 * the desired velocity: the noise of the measured one would be fed back through the sign.
 *
 * \code
 * const vpJointFriction friction = vpJointFriction::of(arm);
 * vpJointVector torque;
 * if (friction.torque(velocity, torque)) {
 *   std::cout << torque.transpose() << " Nm" << std::endl;
 * }
 * \endcode
 */
struct VISP_EXPORT vpJointFriction {
  vpJointVector viscous;   //!< Viscous coefficients Fv, Nm s/rad or N s/m, n numbers >= 0.
  vpJointVector coulomb;   //!< Coulomb friction Fc, Nm or N, n numbers >= 0.
  double smoothing = 0.01; //!< Velocity at which Coulomb friction reaches 76 %, rad/s or m/s, > 0.

  //! Friction of the arm model.
  [[nodiscard]] static vpJointFriction of(const vpArmModel &model);
  //! Friction at these velocities, Nm or N; no allocation. False and zero if a velocity is missing, not finite or
  //! beyond vpArmLargest.
  bool torque(const vpJointVector &velocity, vpJointVector &result) const noexcept;
  /*!
   * \param size : Number of joints.
   * \throw vpException (badValue) naming the field that is out of range, and its value.
   */
  void validate(int size) const;
};

END_VISP_NAMESPACE
#endif
