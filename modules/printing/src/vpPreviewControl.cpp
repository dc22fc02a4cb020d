/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpPreviewControl.h>

#include "vpPrintingCheck.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

using namespace vpPrintingCheck;

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
