/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointFriction.h
 * \brief Friction of the joints and the torque that makes up for it.
 */
#ifndef vpJointFriction_h
#define vpJointFriction_h

#include <visp3/manipulator/vpArmModel.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief F_f = Fv q' + Fc sgn(q'), thesis (3.2)-(3.3), with sgn replaced by tanh(q' / smoothing): of a wanted velocity,
 * so that the noise of the measured one does not come back through the sign.
 */
struct VISP_EXPORT vpJointFriction {
  vpJointVector viscous;   //!< Fv, Nm s/rad or N s/m, n numbers >= 0.
  vpJointVector coulomb;   //!< Fc, Nm or N, n numbers >= 0.
  double smoothing = 0.01; //!< Velocity at which 76 % of the Coulomb friction is given, rad/s or m/s, > 0.

  //! That of the arm's file.
  [[nodiscard]] static vpJointFriction of(const vpArmModel &model);
  //! Friction at these velocities, Nm or N; no allocation. False, and zero, when a velocity is missing, not finite or beyond
  //! vpArmLargest.
  bool torque(const vpJointVector &velocity, vpJointVector &result) const noexcept;
  /*!
   * \param size : Number of joints.
   * \throw vpException (badValue) naming the field that is out of range, and its value.
   */
  void validate(int size) const;
};

END_VISP_NAMESPACE
#endif
