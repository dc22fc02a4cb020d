/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSO3.h
 * \brief Rotations for real-time code: exponential, logarithm and their Jacobians on fixed-size Eigen types.
 *
 * ViSP's vpThetaUVector and vpRotationMatrix allocate on construction; these free functions do not. Notation: for a
 * rotation vector e = theta u, [e]x is its skew matrix and J_r(e) the right Jacobian, so that a rotation R = exp(e)
 * rotating at body rate w (R' = R [w]x) has e' = J_r(e)^-1 w. This J_r^-1 is the L_theta_u of visual servoing with
 * the sign that belongs to R of cdMc (thesis (5.6), corrected):
 * I + theta/2 [u]x + (1 - sinc theta / sinc^2(theta/2)) [u]x^2.
 *
 * Non-finite input, and an angle of 1e154 rad or more, whose square overflows, give NaN.
 */
#ifndef vpSO3_h
#define vpSO3_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_direct_core
 * \brief Functions on rotations that neither allocate nor throw.
 *
 * \code
 * const Eigen::Matrix3d R = vpSO3::exp({0., 0., 0.5}); // rad, about z
 * const Eigen::Vector3d e = vpSO3::log(R);             // (0, 0, 0.5)
 * const Eigen::Vector3d w(0.1, 0., 0.);                // rotates at this body rate, rad/s
 * std::cout << (vpSO3::rightJacobianInverse(e) * w).transpose() << " rad/s" << std::endl; // e'
 * \endcode
 */
namespace vpSO3
{
//! Skew matrix: skew(a) b = a x b.
[[nodiscard]] VISP_EXPORT Eigen::Matrix3d skew(const Eigen::Vector3d &a);

//! Rotation matrix of the rotation vector \e e (rad). Accurate for every angle, zero included, to 1e-16 of the angle.
[[nodiscard]] VISP_EXPORT Eigen::Matrix3d exp(const Eigen::Vector3d &e);

/*!
 * Rotation vector (rad) of \e R, angle in [0, pi]. Accurate near zero and near pi, where (5.7) of the thesis fails;
 * at exactly pi one of the two equal vectors is returned.
 */
[[nodiscard]] VISP_EXPORT Eigen::Vector3d log(const Eigen::Matrix3d &R);

//! Right Jacobian J_r(e): the body rate is w = J_r(e) e'.
[[nodiscard]] VISP_EXPORT Eigen::Matrix3d rightJacobian(const Eigen::Vector3d &e);

//! Inverse of the right Jacobian, e' = J_r(e)^-1 w. Singular at |e| = 2 pi only; valid for |e| <= pi.
[[nodiscard]] VISP_EXPORT Eigen::Matrix3d rightJacobianInverse(const Eigen::Vector3d &e);

/*!
 * Rotation of smallest angle that takes direction \e from to direction \e to, vectors of any length; orthonormal and
 * exact to 1e-15 at every angle. For opposite directions the axis is any one perpendicular to \e from.
 * NaN for a zero vector or one with a non-finite component.
 */
[[nodiscard]] VISP_EXPORT Eigen::Matrix3d minimalRotation(const Eigen::Vector3d &from, const Eigen::Vector3d &to);
} // namespace vpSO3

END_VISP_NAMESPACE
#endif
