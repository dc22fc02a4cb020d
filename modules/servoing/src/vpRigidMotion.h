/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRigidMotion.h
 * \brief Motions under a constant twist, without allocation.
 */
#ifndef vpRigidMotion_h
#define vpRigidMotion_h

#include <visp3/direct_core/vpSO3.h>
#include <visp3/direct_core/vpTwist.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

BEGIN_VISP_NAMESPACE

namespace vpRigidMotion
{
inline Eigen::Vector3d linear(const vpTwist &twist) { return {twist[0], twist[1], twist[2]}; }
inline Eigen::Vector3d angular(const vpTwist &twist) { return {twist[3], twist[4], twist[5]}; }
inline vpTwist twist(const Eigen::Vector3d &v, const Eigen::Vector3d &w)
{
  return {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
}

//! Pose, in the moving frame at the start, after one second of a constant twist in the moving frame.
inline vpRigidTransform exp(const vpTwist &motion)
{
  const Eigen::Vector3d turn = angular(motion);
  return {vpSO3::exp(turn), vpSO3::rightJacobian(-turn) * linear(motion)};
}

//! Inverse of exp(), for rotations of less than half a turn.
inline vpTwist log(const vpRigidTransform &moved)
{
  const Eigen::Vector3d turn = vpSO3::log(moved.R);
  return twist(vpSO3::rightJacobianInverse(-turn) * moved.p, turn);
}

//! aVb v: a twist of a body at the origin and along the axes of b, for the origin and axes of a. \param aMb : Pose of b in a.
inline vpTwist changed(const vpRigidTransform &aMb, const vpTwist &v)
{
  const Eigen::Vector3d w = aMb.R * angular(v);
  return twist(aMb.R * linear(v) + aMb.p.cross(w), w);
}

inline vpTwist sum(vpTwist a, const vpTwist &b)
{
  for (std::size_t i = 0; i < 6; ++i) {
    a[i] += b[i];
  }
  return a;
}

//! True for a rotation, to 1e-6, and a finite translation of a plausible length.
inline bool isRigid(const vpRigidTransform &pose)
{
  const Eigen::Matrix3d rest = pose.R * pose.R.transpose() - Eigen::Matrix3d::Identity();
  return vpIsPlausibleForArm(pose.p) && rest.squaredNorm() < 1e-12 && pose.R.determinant() > 0.;
}
} // namespace vpRigidMotion

END_VISP_NAMESPACE
#endif
