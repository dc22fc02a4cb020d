/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"

#include <visp3/feedforward/vpTargetLossRecovery.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the target-loss recovery");
// Slower than this, m/s and rad/s, counts as standing still and is not recorded.
constexpr double slowest = 1e-6;
// Implausible for a robot; undoing it within the limits would never end.
constexpr double fastest = 1e3;
// Rounding of sums of cycle times must not add a cycle.
constexpr double timeTolerance = 1e-9;

} // namespace

void vpTargetLossSpec::validate() const
{
  fields.notNegative("holdTime", holdTime, "s");
  fields.notNegative("retreatTime", retreatTime, "s");
  fields.positive("maxLinear", maxLinear, "m/s");
  fields.positive("maxAngular", maxAngular, "rad/s");
  fields.in("capacity", capacity, {1, 100000});
}

vpTargetLossRecovery::vpTargetLossRecovery(const vpTargetLossSpec &spec) : m_spec(spec)
{
  spec.validate();
  m_samples.resize(spec.capacity);
}

void vpTargetLossRecovery::reset() noexcept
{
  m_next = m_count = 0;
  m_lostFor = m_undone = 0.;
}

void vpTargetLossRecovery::remember(const vpTwist &v, double duration) noexcept
{
  const double linear = v.linearNorm(), angular = v.angularNorm();
  if ((linear < slowest && angular < slowest) || !(linear < fastest && angular < fastest)) {
    return;
  }
  m_samples[m_next].v = v;
  m_samples[m_next].duration = duration;
  m_next = (m_next + 1) % m_samples.size();
  m_count = std::min(m_count + 1, m_samples.size());
}

vpServoCommand vpTargetLossRecovery::retreat(double dt) noexcept
{
  vpTwist sum; // twist times time
  double budget = dt;
  while (budget > timeTolerance && m_count > 0 && m_undone < m_spec.retreatTime - timeTolerance) {
    const std::size_t last = (m_next + m_samples.size() - 1) % m_samples.size();
    Sample &sample = m_samples[last];
    const double stretch =
        std::max({1., sample.v.linearNorm() / m_spec.maxLinear, sample.v.angularNorm() / m_spec.maxAngular});
    // In recorded time; the camera takes stretch times as long.
    const double piece = std::min({sample.duration, budget / stretch, m_spec.retreatTime - m_undone});
    for (std::size_t i = 0; i < 6; ++i) {
      sum[i] -= sample.v[i] * piece;
    }
    budget -= piece * stretch;
    m_undone += piece;
    sample.duration -= piece;
    if (sample.duration <= timeTolerance) {
      m_next = last;
      --m_count;
    }
  }
  if (budget >= dt) {
    return {vpTwist(), vpServoStatus::Lost};
  }
  return {sum.scaled(1. / dt), vpServoStatus::Retreating};
}

vpServoCommand vpTargetLossRecovery::step(const vpServoCommand &command, double dt) noexcept
{
  if (!(std::isfinite(dt) && dt > 0.) || !command.v.isFinite()) {
    return {vpTwist(), vpServoStatus::InvalidInput};
  }
  if (command.status != vpServoStatus::Holding) {
    m_lostFor = m_undone = 0.;
    remember(command.v, dt);
    return command;
  }
  const bool holding = m_lostFor < m_spec.holdTime - timeTolerance;
  m_lostFor += dt;
  return holding ? vpServoCommand{vpTwist(), vpServoStatus::Holding} : retreat(dt);
}

END_VISP_NAMESPACE
