/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmDynamics.h
 * \brief Inertia matrix, Coriolis and gravity terms of an arm.
 */
#ifndef vpArmDynamics_h
#define vpArmDynamics_h

#include <visp3/manipulator/vpArmModel.h>

#include <memory>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpArmDynamics
 * \ingroup group_manipulator
 * \brief Dynamics M(q) q'' + C(q, q') q' + F_f(q') + g(q) = tau, thesis (3.1), without the friction term. Rotor
 * inertias are on the diagonal of M. Followers take part with the coordinates and velocities of their joints, to which
 * they pass on their torques by their ratios (virtual work).
 *
 * Each function returns false and a zero result if a vector has the wrong size, is not finite or exceeds vpArmLargest,
 * or if the result is not finite.
 *
 * Recursions of Newton and Euler (torques) and of composite rigid bodies (M). An object holds scratch memory: use one per thread.
 *
 * \code
 * vpArmDynamics dynamics(arm);
 * vpJointMatrix M;
 * vpJointVector gravity;
 * if (dynamics.inertia(q, M) && dynamics.gravity(q, gravity)) {
 *   const vpJointVector torque = M * vpJointVector::Constant(arm.size(), 0.5) + gravity; // 0.5 rad/s^2 from rest
 *   std::cout << torque.transpose() << " Nm" << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpArmDynamics
{
public:
  /*!
   * \param model : The arm, with masses; copied.
   * \param gravity : Acceleration of free fall in the base frame, m/s^2.
   * \throw vpException (badValue) naming the first link that has no mass.
   */
  explicit vpArmDynamics(const vpArmModel &model, const Eigen::Vector3d &gravity = Eigen::Vector3d(0., 0., -9.81));
  ~vpArmDynamics();
  vpArmDynamics(vpArmDynamics &&) noexcept;            //!< Moves.
  vpArmDynamics &operator=(vpArmDynamics &&) noexcept; //!< Moves.
  vpArmDynamics(const vpArmDynamics &) = delete;
  vpArmDynamics &operator=(const vpArmDynamics &) = delete;

  //! Inertia matrix M(q), kg m^2 (kg for prismatic joints), symmetric and positive definite.
  bool inertia(const vpJointVector &q, vpJointMatrix &M);
  //! Coriolis and centrifugal torques C(q, q') q', Nm or N.
  bool coriolis(const vpJointVector &q, const vpJointVector &velocity, vpJointVector &torque);
  //! Gravity torques g(q), Nm or N: they hold the arm still.
  bool gravity(const vpJointVector &q, vpJointVector &torque);
  /*!
   * Joint accelerations q'' = M^-1 (tau - C q' - g), rad/s^2 or m/s^2. Include friction in \e torque.
   * \return False also if M is not positive definite.
   */
  bool acceleration(const vpJointVector &q, const vpJointVector &velocity, const vpJointVector &torque,
                    vpJointVector &acceleration);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
