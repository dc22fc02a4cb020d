/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpPrintVelocityControl.h>

#include "vpPrintingCheck.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

using namespace vpPrintingCheck;

vpPrintVelocityControlSpec vpPrintVelocityControlSpec::thesisPid() { return vpPrintVelocityControlSpec(); }

vpPrintVelocityControlSpec vpPrintVelocityControlSpec::thesisFeedforward()
{
  vpPrintVelocityControlSpec spec;
  spec.kp = 0.177;
  spec.ki = 0.0003;
  spec.kd = 0.12;
  spec.feedforward = true;
  spec.model.viscous = 0.02;
  spec.model.coulomb = spec.model.stiction = 0.08;
  return spec;
}

void vpPrintVelocityControlSpec::validate() const
{
  const char *const owner = "velocity control";
  notNegative("kp", owner, kp);
  notNegative("ki", owner, ki);
  notNegative("kd", owner, kd);
  model.validate(owner);
  bound("maxForce", owner, maxForce);
}

vpPrintVelocityControl::vpPrintVelocityControl(const vpPrintVelocityControlSpec &spec) : m_spec(spec)
{
  spec.validate();
}

void vpPrintVelocityControl::reset() noexcept
{
  m_integral = 0.;
  m_error = 0.;
}

vpPrintVelocityControl::Output vpPrintVelocityControl::step(const Input &input) noexcept
{
  Output out;
  const bool wanted = vpIsPlausible(input.velocity) && vpIsPlausible(input.acceleration);
  const bool known = vpIsPlausible(input.velocity) && vpIsPlausible(input.measured);
  out.valid = wanted && known;
  const double error = known ? input.velocity - input.measured : m_error;
  out.feedforward = m_spec.feedforward && wanted ? m_spec.model.force(input.velocity, input.acceleration) : 0.;
  const auto feedback = [&](double integral) {
    return m_spec.kp * error + m_spec.ki * integral + m_spec.kd * (error - m_error);
  };
  double integral = known ? m_integral + error : m_integral; // an old error is not added again
  out.feedback = feedback(integral);
  double force = out.feedback + out.feedforward;
  if (std::fabs(force) > m_spec.maxForce && force * error > 0.) { // the integral would increase against the bound
    integral = m_integral;
    out.feedback = feedback(integral);
    force = out.feedback + out.feedforward;
  }
  out.force = std::clamp(force, -m_spec.maxForce, m_spec.maxForce);
  out.saturated = out.force != force;
  m_integral = integral;
  m_error = error;
  return out;
}

END_VISP_NAMESPACE
