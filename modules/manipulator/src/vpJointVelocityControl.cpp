/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpJointCheck.h"

#include <visp3/manipulator/vpJointVelocityControl.h>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr const char *owner = "joint velocity control";
}

void vpJointVelocityControlSpec::validate() const
{
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

END_VISP_NAMESPACE
