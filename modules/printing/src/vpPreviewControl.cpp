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
  require(maxForce > 0., "maxForce", owner, maxForce, "> 0");
}

vpPreviewControl::vpPreviewControl(const vpPreviewControlSpec &spec) : m_spec(spec) { spec.validate(); }

double vpPreviewControl::force(const Input &input) const noexcept
{
  const double v = input.reference[1], a = input.reference[2], j = input.reference[3];
  const double rate = m_spec.model.mass * j + m_spec.model.viscous * a; // of the force
  const double ahead = m_spec.model.force(v, a) + input.disturbance + m_spec.lag * rate;
  const double back = m_spec.positionGain * (input.referenceFeedback[0] - input.position) +
                      m_spec.velocityGain * (input.referenceFeedback[1] - input.velocity);
  const double force = ahead + back;
  return std::isfinite(force) ? std::clamp(force, -m_spec.maxForce, m_spec.maxForce) : 0.;
}

END_VISP_NAMESPACE
