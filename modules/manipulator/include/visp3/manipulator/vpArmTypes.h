/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmTypes.h
 * \brief Vectors and matrices of a serial arm, stored in place: no heap memory.
 */
#ifndef vpArmTypes_h
#define vpArmTypes_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! \brief Maximum number of joints of an arm.
constexpr int vpArmMaxJoints = 16;

/*!
 * \ingroup group_manipulator
 * \brief Largest valid length and position coordinate of links, capsules and obstacles, m. Up to it distances are
 * rounded by less than the 1e-9 m that certificates allow for.
 */
constexpr double vpLargestLength = 1e4;
//! \ingroup group_manipulator
//! \brief Largest valid joint coordinate, rad or m: up to it rounding turns a joint by less than 1e-10.
constexpr double vpLargestCoordinate = 1e6;

//! \ingroup group_manipulator
//! \brief One number per joint: rad, rad/s, Nm, ... (revolute) or m, m/s, N, ... (prismatic). Size n <= vpArmMaxJoints.
using vpJointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, vpArmMaxJoints, 1>;
//! \ingroup group_manipulator
//! \brief Jacobian, 6 x n, linear part (rows 0-2) first, then angular.
using vpArmJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, vpArmMaxJoints>;
//! \ingroup group_manipulator
//! \brief Joint-space matrix, n x n.
using vpJointMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, vpArmMaxJoints, vpArmMaxJoints>;

//! \ingroup group_manipulator
//! \brief Largest valid magnitude of a position, velocity, torque, gain or any other number of an arm, in its unit.
//! Squares and products of valid numbers do not overflow.
constexpr double vpArmLargest = 1e9;
//! \ingroup group_manipulator
//! \brief True if no number exceeds vpArmLargest; false for NaN.
template <class Derived> [[nodiscard]] bool vpIsPlausibleForArm(const Eigen::MatrixBase<Derived> &numbers) noexcept
{
  return (numbers.array().abs() <= vpArmLargest).all();
}

/*!
 * \ingroup group_manipulator
 * \brief Pose aMb of a frame b in a frame a, as a rotation and a translation (m). ViSP's vpHomogeneousMatrix allocates.
 *
 * \code
 * vpArmData data;
 * vpArmKinematics::update(arm, q, data);
 * const vpRigidTransform eMc{Eigen::Matrix3d::Identity(), {0., 0., 0.1}}; // m
 * const vpRigidTransform cMf = (data.tool * eMc).inverse();
 * std::cout << cMf.toHomogeneous() << std::endl;
 * \endcode
 */
struct VISP_EXPORT vpRigidTransform {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity(); //!< Rotation aRb.
  Eigen::Vector3d p = Eigen::Vector3d::Zero();     //!< Origin of b in a, m.

  //! Composition aMc = aMb * bMc.
  [[nodiscard]] vpRigidTransform operator*(const vpRigidTransform &bMc) const { return {R * bMc.R, p + R * bMc.p}; }
  //! Inverse bMa.
  [[nodiscard]] vpRigidTransform inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
  //! Conversion to ViSP. Allocates.
  [[nodiscard]] vpHomogeneousMatrix toHomogeneous() const;
  //! Conversion from ViSP.
  [[nodiscard]] static vpRigidTransform fromHomogeneous(const vpHomogeneousMatrix &M);
};

END_VISP_NAMESPACE
#endif
