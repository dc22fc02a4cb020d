/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpJointCheck.h"

#include <visp3/manipulator/vpJointVelocityEstimator.h>

BEGIN_VISP_NAMESPACE

vpJointVelocityEstimator::vpJointVelocityEstimator(int size, double period, double bandwidth)
  : m_period(period), m_alpha(0.), m_beta(0.)
{
  vpJointCheck::positive("period", "joint velocity estimator", period);
  vpJointCheck::positive("bandwidth", "joint velocity estimator", bandwidth);
  if (size < 1 || size > vpArmMaxJoints) {
    throw vpException(vpException::badValue, "size of the joint velocity estimator is %d, must be 1 to %d", size,
                      vpArmMaxJoints);
  }
  const double pole = std::exp(-bandwidth * period);
  m_alpha = 1. - pole * pole;
  m_beta = (1. - pole) * (1. - pole);
  m_position.setZero(size);
  m_velocity.setZero(size);
}

void vpJointVelocityEstimator::reset() noexcept
{
  m_started = m_measured = false;
  m_velocity.setZero();
}

const vpJointVector &vpJointVelocityEstimator::step(const vpJointVector &q, const vpJointVector &acceleration) noexcept
{
  const Eigen::Index n = m_position.size();
  m_measured = q.size() == n && vpIsPlausibleForArm(q);
  if (!m_started) {
    if (m_measured) {
      m_position = q;
      m_started = true;
    }
    return m_velocity;
  }
  const bool given = acceleration.size() == n && vpIsPlausibleForArm(acceleration);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double a = given ? acceleration(i) : 0.;
    m_position(i) += m_period * (m_velocity(i) + 0.5 * m_period * a);
    m_velocity(i) += m_period * a;
    if (m_measured) {
      const double e = q(i) - m_position(i);
      m_position(i) += m_alpha * e;
      m_velocity(i) += m_beta / m_period * e;
    }
  }
  return m_velocity;
}

END_VISP_NAMESPACE
