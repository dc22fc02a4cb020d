/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpPreviewControl.h>
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

void vpPreviewControlSpec::validate() const
{
  const char *const owner = "preview control";
  model.validate(owner);
  notNegative("positionGain", owner, positionGain);
  notNegative("velocityGain", owner, velocityGain);
  notNegative("lag", owner, lag);
  notNegative("delay", owner, delay);
  positive("period", owner, period);
  bound("maxForce", owner, maxForce);
}

vpPreviewControl::vpPreviewControl(const vpPreviewControlSpec &spec) : m_spec(spec) { spec.validate(); }

vpPreviewControl::Output vpPreviewControl::command(const Input &input) const noexcept
{
  Output out;
  const auto plausible = [](const vpAxisState &x) { return std::all_of(x.begin(), x.end(), vpIsPlausible); };
  out.valid = plausible(input.reference) && plausible(input.referenceFeedback) && vpIsPlausible(input.position) &&
              vpIsPlausible(input.velocity) && vpIsPlausible(input.disturbance);
  if (!out.valid) {
    return out;
  }
  const double v = input.reference[1], a = input.reference[2], j = input.reference[3];
  const double rate = m_spec.model.mass * j + m_spec.model.viscous * a; // rate of the force
  const double ahead = m_spec.model.force(v, a) + input.disturbance + m_spec.lag * rate;
  const double back = m_spec.positionGain * (input.referenceFeedback[0] - input.position) +
                      m_spec.velocityGain * (input.referenceFeedback[1] - input.velocity);
  out.force = std::clamp(ahead + back, -m_spec.maxForce, m_spec.maxForce);
  out.saturated = out.force != ahead + back;
  return out;
}

END_VISP_NAMESPACE
