/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpJointCheck.h"

#include <visp3/manipulator/vpJointPositionControl.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr const char *owner = "joint position control";
}

void vpJointPositionControlSpec::validate() const
{
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

END_VISP_NAMESPACE
