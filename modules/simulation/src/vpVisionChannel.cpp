/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpVisionChannel.h>

#include <visp3/core/vpException.h>

#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
// Tolerance of times, since 0.1 + 0.2 must count as 0.3; far below any cycle.
constexpr double timeTolerance = 1e-9;
} // namespace

vpVisionChannel::vpVisionChannel(double frameRate, double latency) : m_frameRate(frameRate), m_latency(latency)
{
  if (!(frameRate > 0.) || !std::isfinite(frameRate)) {
    throw vpException(vpException::badValue, "frame rate is %g Hz, must be > 0 and finite", frameRate);
  }
  if (!(latency >= 0.) || !std::isfinite(latency)) {
    throw vpException(vpException::badValue, "latency is %g s, must be >= 0 and finite", latency);
  }
}

bool vpVisionChannel::due(double now) const { return now + timeTolerance >= m_nextFrame / m_frameRate; }

void vpVisionChannel::push(const vpServoMeasurement &measurement)
{
  m_pending.push_back(measurement);
  // Counted from the start, not from this exposure, so that a late frame does not shift later ones.
  m_nextFrame = std::floor((measurement.time + timeTolerance) * m_frameRate) + 1.;
}

bool vpVisionChannel::pop(double now, vpServoMeasurement &result)
{
  if (m_pending.empty() || m_pending.front().time + m_latency > now + timeTolerance) {
    return false;
  }
  result = std::move(m_pending.front());
  m_pending.pop_front();
  return true;
}

END_VISP_NAMESPACE
