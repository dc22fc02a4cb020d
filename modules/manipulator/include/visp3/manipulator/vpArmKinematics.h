/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmKinematics.h
 * \brief Forward kinematics, Jacobians and their derivatives of a vpArmModel.
 */
#ifndef vpArmKinematics_h
#define vpArmKinematics_h

#include <visp3/manipulator/vpArmModel.h>

#include <array>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! \brief Axes in which a velocity of the arm is expressed, and its reference point.
enum class vpArmFrame {
  Base,        //!< Origin of the end effector, axes of the base (fJe of ViSP).
  EndEffector, //!< Origin and axes of the end effector (eJe of ViSP).
  Camera       //!< Origin and axes of the camera, as commanded by visual servoing.
};

/*!
 * \ingroup group_manipulator
 * \brief Kinematics of an arm in one configuration, filled by vpArmKinematics::forward() and jacobian(); one per
 * thread.
 */
struct VISP_EXPORT vpArmData {
  int size = 0;    //!< Number of joints n of the arm; 0: not filled.
  vpJointVector q; //!< Configuration, rad or m.
  std::array<vpRigidTransform, vpArmMaxJoints>
      joint;             //!< Frames of the l joints and followers in the base; z is the axis, each moves with its link.
  vpRigidTransform tool; //!< fMe: end effector in the base.
  vpArmJacobian J;       //!< Geometric Jacobian (3.9)-(3.13) in vpArmFrame::Base.
};

/*!
 * \ingroup group_manipulator
 * \brief Kinematics of fixed capacity; no allocation, exception, lock or output. Joints are numbered from 0 here.
 *
 * A joint moves the end effector and the camera as far as their links are behind it, see vpArmSpec::toolLink and
 * vpArmSpec::cameraLink; its other columns are 0. The columns of followers, times their ratios, are added to that of
 * their joint. In (3.12)-(3.13), as corrected, z_{i-1} is the third column of R^0_{i-1}, the axis in the base frame.
 *
 * \code
 * vpArmData data;
 * if (vpArmKinematics::update(arm, q, data)) { // false: q does not fit
 *   const vpArmJacobian J = vpArmKinematics::geometric(arm, data, vpArmFrame::Camera);
 *   std::cout << "tool at " << data.tool.p.transpose() << " m, camera moves with " << (J * velocity).transpose()
 *             << " m/s, rad/s" << std::endl;
 * }
 * \endcode
 */
namespace vpArmKinematics
{
/*!
 * Computes the frames of all joints and of the end effector, (3.8), and stores the configuration.
 * \param model : The arm.
 * \param q : Configuration, n numbers, rad or m.
 * \param data : Receives the frames.
 * \return False if \e q has the wrong size, is not finite or exceeds vpArmLargest: all frames, and what is computed
 * from them, are then NaN, so that every comparison fails.
 */
VISP_EXPORT bool forward(const vpArmModel &model, const vpJointVector &q, vpArmData &data) noexcept;
//! Geometric Jacobian in the base frame; after forward().
VISP_EXPORT void jacobian(const vpArmModel &model, vpArmData &data) noexcept;
//! Calls forward() and jacobian(); returns the result of forward().
VISP_EXPORT bool update(const vpArmModel &model, const vpJointVector &q, vpArmData &data) noexcept;

//! Frame of link \e i (1..l; 0 is the base) in the base; after forward().
[[nodiscard]] VISP_EXPORT vpRigidTransform link(const vpArmModel &model, const vpArmData &data, int i) noexcept;
//! Camera frame in the base, fMc; after forward().
[[nodiscard]] VISP_EXPORT vpRigidTransform camera(const vpArmModel &model, const vpArmData &data) noexcept;

//! Geometric Jacobian in the given frame; after jacobian().
[[nodiscard]] VISP_EXPORT vpArmJacobian geometric(const vpArmModel &model, const vpArmData &data,
                                                  vpArmFrame frame) noexcept;
/*!
 * Analytic Jacobian (3.14) for the pose (position, rotation vector theta u) of the end effector in the base: the
 * angular rows are J_l^-1(theta u) times the geometric ones. Valid for an angle <= pi; the rotation vector jumps at pi.
 * After jacobian().
 */
[[nodiscard]] VISP_EXPORT vpArmJacobian analytic(const vpArmModel &model, const vpArmData &data) noexcept;
/*!
 * Linear Jacobian of the origin of joint or follower \e k of the chain (one column per joint): the partial Jacobian
 * used by the distance indices. In the base frame; after forward(). \e k = l is the end effector.
 */
[[nodiscard]] VISP_EXPORT Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, vpArmMaxJoints>
pointJacobian(const vpArmModel &model, const vpArmData &data, int k) noexcept;

/*!
 * Derivative dJ/dq_k in the given frame, exact: in the base a revolute joint k <= i rotates column i; for a revolute
 * joint i < k the lever arm changes by column k; prismatic joints change nothing else. After forward().
 */
[[nodiscard]] VISP_EXPORT vpArmJacobian derivative(const vpArmModel &model, const vpArmData &data, int k,
                                                   vpArmFrame frame) noexcept;
//! Derivative dJ/dt = sum_k dJ/dq_k q'_k in the given frame; after jacobian(). NaN for velocities of the wrong size,
//! not finite or beyond vpArmLargest.
[[nodiscard]] VISP_EXPORT vpArmJacobian timeDerivative(const vpArmModel &model, const vpArmData &data,
                                                       const vpJointVector &velocity, vpArmFrame frame) noexcept;
} // namespace vpArmKinematics

END_VISP_NAMESPACE
#endif
