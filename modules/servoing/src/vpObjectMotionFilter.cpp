/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpObjectMotionFilter.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double fastest = 1.;          // m/s and rad/s: standard deviation of the velocity before it is measured
constexpr double positionNoise = 0.002; // m, where no covariance is known, at the beginning
constexpr double rotationNoise = 0.01;  // rad
constexpr double leastNoise = 1e-5;     // m and rad: a perfect simulation must not make the filter singular
constexpr double largestMisfit = 30.;   // chi-square with 3 degrees of freedom: 1.4e-6
constexpr double learning = 0.1;

// Rotates a covariance of the camera frame to the base, with a floor.
Eigen::Matrix3d inBase(const Eigen::Matrix3d &R, const vpPoseCovariance &covariance, std::size_t block, double variance)
{
  const Eigen::Matrix3d floor = leastNoise * leastNoise * Eigen::Matrix3d::Identity();
  if (!covariance.known) {
    return floor + variance * Eigen::Matrix3d::Identity();
  }
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> C(covariance.C.data());
  const auto at = static_cast<Eigen::Index>(block);
  return floor + R * C.block<3, 3>(at, at) * R.transpose();
}
} // namespace

void vpObjectMotionFilter::Channel::restart(const Eigen::Matrix3d &noise, double rateSigma) noexcept
{
  rate.setZero();
  P.setZero();
  P.topLeftCorner<3, 3>() = noise;
  P.bottomRightCorner<3, 3>().diagonal().setConstant(rateSigma * rateSigma);
}

void vpObjectMotionFilter::Channel::predict(double dt) noexcept
{
  Eigen::Matrix<double, 6, 6> F = Eigen::Matrix<double, 6, 6>::Identity();
  F.topRightCorner<3, 3>().diagonal().setConstant(dt);
  P = F * P * F.transpose();
  const double q = change * change * dt; // white acceleration
  P.topLeftCorner<3, 3>().diagonal().array() += q * dt * dt / 3.;
  P.topRightCorner<3, 3>().diagonal().array() += q * dt / 2.;
  P.bottomLeftCorner<3, 3>().diagonal().array() += q * dt / 2.;
  P.bottomRightCorner<3, 3>().diagonal().array() += q;
}

double vpObjectMotionFilter::Channel::misfit(const Eigen::Vector3d &residual,
                                             const Eigen::Matrix3d &noise) const noexcept
{
  const Eigen::Matrix3d S = P.topLeftCorner<3, 3>() + noise;
  return residual.dot(S.inverse() * residual);
}

// Returns the correction of the coordinates.
Eigen::Vector3d vpObjectMotionFilter::Channel::correct(const Eigen::Vector3d &residual,
                                                       const Eigen::Matrix3d &noise) noexcept
{
  const Eigen::Matrix3d S = P.topLeftCorner<3, 3>() + noise;
  const Eigen::Matrix<double, 6, 3> K = P.leftCols<3>() * S.inverse();
  P -= (K * P.topRows<3>()).eval();
  P = (0.5 * (P + P.transpose())).eval();
  rate += K.bottomRows<3>() * residual;
  return K.topRows<3>() * residual;
}

void vpObjectMotionFilter::Channel::learnNoise(const Eigen::Vector3d &residual) noexcept
{
  const double surplus = (residual.squaredNorm() - P.topLeftCorner<3, 3>().trace()) / 3.;
  variance += learning * (std::max(surplus, 0.) - variance);
}

vpObjectMotionFilter::vpObjectMotionFilter(double linearChange, double angularChange, double longestGap)
  : m_longestGap(longestGap)
{
  m_position.change = linearChange;
  m_position.variance = positionNoise * positionNoise;
  m_rotation.change = angularChange;
  m_rotation.variance = rotationNoise * rotationNoise;
}

void vpObjectMotionFilter::restart(const vpRigidTransform &fMo, const Eigen::Matrix3d &position,
                                   const Eigen::Matrix3d &rotation) noexcept
{
  m_position.restart(position, fastest);
  m_rotation.restart(rotation, fastest);
  m_pose = fMo;
  m_hasPose = true;
  m_missed = false;
}

void vpObjectMotionFilter::add(const vpRigidTransform &fMc, const vpRigidTransform &cMo,
                               const vpPoseCovariance &covariance, double time)
{
  const vpRigidTransform fMo = fMc * cMo;
  const Eigen::Matrix3d position = inBase(fMc.R, covariance, 0, m_position.variance);
  const Eigen::Matrix3d rotation = inBase(fMc.R, covariance, 3, m_rotation.variance);
  const double dt = time - m_time;
  if (!m_hasPose || !(dt > 0. && dt <= m_longestGap)) {
    restart(fMo, position, rotation);
  }
  else {
    m_position.predict(dt);
    m_rotation.predict(dt);
    m_pose.p += dt * m_position.rate;
    m_pose.R = vpSO3::exp(dt * m_rotation.rate) * m_pose.R;
    const Eigen::Vector3d moved = fMo.p - m_pose.p, turned = vpSO3::log(fMo.R * m_pose.R.transpose());
    const bool fits =
        m_position.misfit(moved, position) < largestMisfit && m_rotation.misfit(turned, rotation) < largestMisfit;
    if (!covariance.known) {
      m_position.learnNoise(moved);
      m_rotation.learnNoise(turned);
    }
    if (fits) {
      m_pose.p += m_position.correct(moved, position);
      m_pose.R = Eigen::Quaterniond(vpSO3::exp(m_rotation.correct(turned, rotation)) * m_pose.R)
                     .normalized()
                     .toRotationMatrix();
      m_missed = false;
    }
    else if (m_missed) {
      restart(fMo, position, rotation);
    }
    else {
      m_missed = true;
    }
  }
  m_time = time;
  m_motion = {true, m_position.rate, m_rotation.rate, std::sqrt(m_position.P.bottomRightCorner<3, 3>().trace()),
              std::sqrt(m_rotation.P.bottomRightCorner<3, 3>().trace())};
}

END_VISP_NAMESPACE
