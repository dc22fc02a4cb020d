/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpStopSupervisor.h>

#include "vpStopPlan.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double slack = 1e-4; // m: so much nearer an arm at its margin may come on its way away

void requireGood(const char *field, double value, bool good, const char *range)
{
  if (!good || !std::isfinite(value)) {
    throw vpException(vpException::badValue, "%s of the stop supervisor is %g, must be %s", field, value, range);
  }
}
} // namespace

void vpStopSupervisorSpec::validate() const
{
  requireGood("period", period, period > 0., "> 0 s");
  requireGood("margin", margin, margin >= 0., ">= 0 m");
  requireGood("latency", latency, latency >= 0., ">= 0 s");
  requireGood("resolution", resolution, resolution > 0., "> 0 m");
  requireGood("attempts", attempts, attempts >= 1 && attempts <= 16, "1 to 16");
}

const char *vpSupervisedVelocity::sentence() const noexcept
{
  switch (status) {
  case vpSupervision::Passed:
    return "The arm moves as wished.";
  case vpSupervision::Slowed:
    return "The arm moves slower than wished, so that it can stop in time.";
  case vpSupervision::Stopping:
    return "The arm brakes: no motion towards the wish could be stopped in time.";
  case vpSupervision::Standing:
    return "The arm stands: no motion towards the wish could be stopped in time.";
  case vpSupervision::Unsafe:
    return "The arm brakes, but something has come into its way to rest.";
  case vpSupervision::InvalidInput:
    break;
  }
  return "The configuration or the wish is not finite or of a wrong size; the arm brakes.";
}

vpStopSupervisor::vpStopSupervisor(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec)
  : m_scene(&scene), m_spec(spec), m_certificate(scene, {0., spec.resolution > 0. ? spec.resolution : 1e-4}),
    m_candidate(scene.arm().size()), m_stop(scene.arm().size())
{
  spec.validate();
  scene.arm().requireMotionLimits("a stop supervisor");
}

void vpStopSupervisor::reset() noexcept { m_moving = false; }

bool vpStopSupervisor::admit(const vpJointVector &q, const vpJointVector &velocity, vpClearance &pair) noexcept
{
  planStop(m_scene->arm(), q, velocity, m_spec.period, m_candidate);
  // Where it would come to rest is most often what is wrong, and quickly told.
  const double end = m_candidate.duration();
  vpJointVector rest(q.size());
  for (int j = 0; j < rest.size(); ++j) {
    rest(j) = m_candidate.at(j, end)[0];
  }
  m_scene->place(rest, m_data);
  const vpClearance there = m_scene->clearance(m_data, m_spec.margin, m_spec.latency + end);
  if (there.kind == vpCollisionKind::None) {
    m_certificate.setMargin(m_spec.margin);
    const vpTrajectoryClearance verdict = m_certificate.verdict(m_candidate, 0., end, m_spec.latency);
    if (verdict.isFree()) {
      return true;
    }
    pair = verdict.pair;
  }
  else {
    pair = there;
  }
  m_scene->place(q, m_data);
  const vpClearance now = m_scene->clearance(m_data, m_spec.margin + slack, m_spec.latency);
  return now.distance < m_spec.margin + slack && isRetreat(now, there.distance);
}

// An arm at or within its margin may move where it ends no nearer than it is and comes hardly nearer on the way.
bool vpStopSupervisor::isRetreat(const vpClearance &now, double there) noexcept
{
  const double margin = now.distance - slack;
  m_certificate.setMargin(margin);
  return there >= now.distance && margin >= 0. &&
         m_certificate.verdict(m_candidate, 0., m_candidate.duration(), m_spec.latency).isFree();
}

void vpStopSupervisor::step(const vpJointVector &q, const vpJointVector &wish, vpSupervisedVelocity &output) noexcept
{
  const int n = m_scene->arm().size();
  // The stop of the last period, one period on: the mean of its ramp.
  vpJointVector braking = vpJointVector::Zero(n);
  for (int j = 0; j < n && m_moving; ++j) {
    braking(j) = (m_stop.at(j, m_time + m_spec.period)[0] - m_stop.at(j, m_time)[0]) / m_spec.period;
  }
  output.pair = vpClearance();
  output.share = 0.;
  output.status = vpSupervision::InvalidInput;
  if (q.size() == n && wish.size() == n && q.allFinite() && wish.allFinite()) {
    double share = 1.;
    vpClearance pair;
    for (int attempt = 0; attempt < m_spec.attempts; ++attempt, share *= 0.5) {
      const vpJointVector velocity = braking + share * (wish - braking);
      if (admit(q, velocity, pair)) {
        std::swap(m_stop, m_candidate);
        m_time = m_spec.period;
        m_moving = velocity.cwiseAbs().maxCoeff() > 0.;
        output.velocity = velocity;
        output.share = share;
        output.status = attempt == 0 ? vpSupervision::Passed : vpSupervision::Slowed;
        output.pair = attempt == 0 ? vpClearance() : pair;
        return;
      }
    }
    output.pair = pair;
    output.status = m_moving ? vpSupervision::Stopping : vpSupervision::Standing;
    if (m_moving) { // is it still free, with the objects where they are now?
      m_certificate.setMargin(0.);
      const vpTrajectoryClearance rest = m_certificate.verdict(m_stop, m_time, m_stop.duration(), m_spec.latency);
      output.status = rest.isFree() ? output.status : vpSupervision::Unsafe;
      output.pair = rest.isFree() ? output.pair : rest.pair;
    }
  }
  output.velocity = braking;
  m_time += m_spec.period;
  m_moving = m_moving && m_time < m_stop.duration();
}

END_VISP_NAMESPACE
