/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/manipulator/vpJointFriction.h>
#include <visp3/manipulator/vpJointPositionControl.h>
#include <visp3/manipulator/vpJointVelocityControl.h>
#include <visp3/manipulator/vpJointVelocityEstimator.h>

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Checks of specifications with one number per joint, for the constructors of the joint controllers. Numbers are
// bounded so that no step overflows.
namespace vpJointCheck
{
inline bool isUsual(double value) { return value >= 1e-12 && value <= vpArmLargest; }
inline void positive(const char *field, const char *owner, double value)
{
  if (!isUsual(value)) {
    throw vpException(vpException::badValue, "%s of the %s is %g, must be > 0 and finite (1e-12 to 1e9)", field, owner,
                      value);
  }
}
inline void size(const char *field, const char *owner, const vpJointVector &vector, int n)
{
  if (vector.size() != n || n < 1) {
    throw vpException(vpException::badValue, "%s of the %s has %d numbers, must have one for each of %d joints", field,
                      owner, static_cast<int>(vector.size()), n);
  }
}
inline void notNegative(const char *field, const char *owner, const vpJointVector &vector, int n)
{
  size(field, owner, vector, n);
  for (int i = 0; i < n; ++i) {
    if (vector(i) != 0. && !isUsual(vector(i))) {
      throw vpException(vpException::badValue,
                        "%s of joint %d of the %s is %g, must be >= 0 and finite (0, or 1e-12 to 1e9)", field, i + 1,
                        owner, vector(i));
    }
  }
}
//! An infinite limit is allowed.
inline void limit(const char *field, const char *owner, const vpJointVector &vector, int n)
{
  size(field, owner, vector, n);
  for (int i = 0; i < n; ++i) {
    if (!(vector(i) >= 1e-12)) {
      throw vpException(vpException::badValue, "%s of joint %d of the %s is %g, must be > 0, at least 1e-12", field,
                        i + 1, owner, vector(i));
    }
  }
}
} // namespace vpJointCheck
} // namespace

vpJointFriction vpJointFriction::of(const vpArmModel &model)
{
  vpJointFriction friction;
  friction.viscous.resize(model.size());
  friction.coulomb.resize(model.size());
  for (int i = 0; i < model.size(); ++i) {
    friction.viscous(i) = model.spec().joints[static_cast<std::size_t>(i)].viscous;
    friction.coulomb(i) = model.spec().joints[static_cast<std::size_t>(i)].coulomb;
  }
  return friction;
}

bool vpJointFriction::torque(const vpJointVector &velocity, vpJointVector &result) const noexcept
{
  result.setZero(viscous.size());
  if (velocity.size() != viscous.size() || !vpIsPlausibleForArm(velocity)) {
    return false;
  }
  for (int i = 0; i < viscous.size(); ++i) {
    result(i) = viscous(i) * velocity(i) + coulomb(i) * std::tanh(velocity(i) / smoothing);
  }
  if (!result.allFinite()) {
    result.setZero();
    return false;
  }
  return true;
}

void vpJointFriction::validate(int size) const
{
  vpJointCheck::notNegative("viscous", "joint friction", viscous, size);
  vpJointCheck::notNegative("coulomb", "joint friction", coulomb, size);
  vpJointCheck::positive("smoothing", "joint friction", smoothing);
}

void vpJointPositionControlSpec::validate() const
{
  const char *const owner = "joint position control";
  const int n = static_cast<int>(kp.size());
  vpJointCheck::notNegative("kp", owner, kp, n);
  vpJointCheck::notNegative("kd", owner, kd, n);
  vpJointCheck::limit("maxTorque", owner, maxTorque, n);
  if (compensateFriction) {
    friction.validate(n);
  }
}

vpJointPositionControl::vpJointPositionControl(const vpJointPositionControlSpec &spec) : m_spec(spec)
{
  spec.validate();
}

void vpJointPositionControl::step(const Input &input, Output &output) const noexcept
{
  const Eigen::Index n = m_spec.kp.size();
  output.saturated = 0;
  output.torque.setZero(n);
  output.valid = true;
  for (const vpJointVector *vector :
       {&input.q, &input.velocity, &input.wantedQ, &input.wantedVelocity, &input.feedforward}) {
    output.valid = output.valid && vector->size() == n && vpIsPlausibleForArm(*vector);
  }
  if (!output.valid) {
    return;
  }
  if (m_spec.compensateFriction) {
    output.valid = m_spec.friction.torque(input.wantedVelocity, output.torque);
  }
  output.torque += m_spec.kp.cwiseProduct(input.wantedQ - input.q) +
                   m_spec.kd.cwiseProduct(input.wantedVelocity - input.velocity) + input.feedforward;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double most = m_spec.maxTorque(i);
    if (std::fabs(output.torque(i)) > most) {
      output.torque(i) = std::copysign(most, output.torque(i));
      output.saturated |= 1U << i;
    }
  }
}

void vpJointVelocityControlSpec::validate() const
{
  const char *const owner = "joint velocity control";
  const int n = static_cast<int>(kp.size());
  vpJointCheck::positive("period", owner, period);
  vpJointCheck::notNegative("kp", owner, kp, n);
  vpJointCheck::notNegative("ki", owner, ki, n);
  vpJointCheck::limit("maxTorque", owner, maxTorque, n);
  if (compensateFriction) {
    friction.validate(n);
  }
}

vpJointVelocityControl::vpJointVelocityControl(const vpJointVelocityControlSpec &spec) : m_spec(spec)
{
  spec.validate();
  reset();
}

void vpJointVelocityControl::reset() noexcept { m_integral.setZero(m_spec.kp.size()); }

void vpJointVelocityControl::step(const Input &input, Output &output) noexcept
{
  const Eigen::Index n = m_spec.kp.size();
  output.saturated = 0;
  output.torque.setZero(n);
  output.valid = true;
  for (const vpJointVector *vector : {&input.velocity, &input.wantedVelocity, &input.feedforward}) {
    output.valid = output.valid && vector->size() == n && vpIsPlausibleForArm(*vector);
  }
  if (!output.valid) {
    return;
  }
  if (m_spec.compensateFriction) {
    output.valid = m_spec.friction.torque(input.wantedVelocity, output.torque);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const double e = input.wantedVelocity(i) - input.velocity(i), most = m_spec.maxTorque(i);
    const double integral = m_integral(i) + m_spec.period * e;
    double torque = output.torque(i) + input.feedforward(i) + m_spec.kp(i) * e + m_spec.ki(i) * integral;
    const bool over = std::fabs(torque) > most;
    if (over) {
      torque = std::copysign(most, torque);
      output.saturated |= 1U << i;
    }
    if (!over || torque * e < 0.) {
      m_integral(i) = integral;
    }
    output.torque(i) = torque;
  }
}

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
