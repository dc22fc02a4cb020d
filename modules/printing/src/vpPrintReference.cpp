/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpPrintReference.h>
#include <visp3/trajectory/vpMinimumDuration.h>

#include "vpPrintingCheck.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

using namespace vpPrintingCheck;

namespace
{
constexpr double shortest = 0.05; // frame; minimum time to a target
constexpr int quintic = 3;        // conditions at each end
constexpr double largestState = 1e30;

bool isUsable(const vpPrintTarget &target)
{
  return vpIsPlausible(target.position) && vpIsPlausible(target.velocity) && vpIsPlausible(target.duration);
}

vpAxisState relative(const vpAxisState &x) { return {{0., x[1], x[2], 0.}}; }
vpAxisState endOf(const vpAxisState &from, const vpPrintTarget &target)
{
  return {{target.position - from[0], target.velocity, 0., 0.}};
}
} // namespace

void vpPrintReferenceSpec::validate() const
{
  const char *const owner = "print reference";
  positive("meanVelocity", owner, meanVelocity);
  positive("dropTime", owner, dropTime);
  positive("maxVelocity", owner, maxVelocity);
  bound("maxAcceleration", owner, maxAcceleration);
  notNegative("freeze", owner, freeze);
}

vpPrintReference::vpPrintReference(const vpPrintReferenceSpec &spec) : m_spec(spec)
{
  spec.validate();
  reset(0., 0., -1);
}

void vpPrintReference::reset(double now, double position, long passed) noexcept
{
  if (!vpIsPlausible(now) || !vpIsPlausible(position)) {
    return;
  }
  m_now = now;
  m_count = 0;
  m_hasTarget = false;
  m_passed = passed;
  m_since = now;
  m_start = {{position, 0., 0., 0.}};
  m_output = Output();
  m_output.state = m_start;
}

double vpPrintReference::durationTo(const vpAxisState &from, const vpPrintTarget &target) const noexcept
{
  const double way = std::fabs(target.position - from[0]);
  const double ends = 0.5 * (std::fabs(from[1]) + std::fabs(target.velocity));
  double T = target.duration;
  if (!(T > 0.)) {
    switch (m_spec.mode) {
    case vpPrintReferenceMode::FixedArrival:
      T = m_spec.dropTime;
      break;
    case vpPrintReferenceMode::CellVelocity: {
      // Faster than the mean of both ends by the difference of the mean velocity between cells and the velocity at
      // cells.
      const double fastest = std::max(std::fabs(from[1]), std::fabs(target.velocity));
      const double faster = std::max(0., m_spec.meanVelocity - fastest);
      T = way / std::max(ends + faster, 1e-3);
      break;
    }
    case vpPrintReferenceMode::LimitedVelocity: {
      vpAxisLimits limits;
      limits.velocity = m_spec.maxVelocity;
      limits.acceleration = m_spec.maxAcceleration;
      const vpAxisState a = relative(from), z = endOf(from, target);
      const double floor = std::max(shortest, vpMinimumDuration::lowerBound(a, z, limits));
      const vpDurationAnswer answer =
          vpMinimumDuration::solve(vpMotionFamily::pointToPoint(a, z, quintic), limits, floor);
      T = answer.kind == vpDurationAnswer::Kind::Infeasible ? way / std::max(ends, 1e-3) : answer.T;
      break;
    }
    default:
      T = way / std::max(ends, 1e-3);
    }
  }
  return std::max(std::isfinite(T) ? T : way / std::max(ends, 1e-3), shortest);
}

void vpPrintReference::plan(vpTrajectorySegment &piece, const vpAxisState &from, const vpPrintTarget &target,
                            double begin, double duration) noexcept
{
  piece.begin = begin;
  piece.duration = std::max(duration, shortest);
  piece.p = vpMotionFamily::pointToPoint(relative(from), endOf(from, target), quintic).at(piece.duration);
  piece.p[0] += from[0];
}

vpAxisState vpPrintReference::at(double asked) const noexcept
{
  const double time = std::isnan(asked) ? m_now : std::clamp(asked, m_now - longestGap, m_now + longestGap);
  if (m_count > 0) {
    return vpEvaluatePieces(m_pieces.data(), m_count, time);
  }
  return {{m_start[0] + m_start[1] * (time - m_since), m_start[1], 0., 0.}};
}

const vpPrintReference::Output &vpPrintReference::step(double now, const vpPrintTarget *targets,
                                                       std::size_t count) noexcept
{
  m_output.newTarget = false;
  m_output.valid = vpIsPlausible(now) && now >= m_now && now <= m_now + longestGap;
  if (!m_output.valid) {
    return m_output;
  }
  m_now = now;
  const std::size_t known = targets == nullptr ? 0 : count;
  const auto after = [&](long key) {
    std::size_t i = 0;
    while (i < known && (targets[i].key <= key || !isUsable(targets[i]))) {
      ++i;
    }
    return i;
  };
  // Advance to the next targets; more than one if a step was long.
  for (int guard = 0; guard < 16; ++guard) {
    if (m_hasTarget && now >= m_pieces[0].begin + m_pieces[0].duration) {
      m_since = m_pieces[0].begin + m_pieces[0].duration;
      m_start = {{m_target.position, m_target.velocity, 0., 0.}};
      m_passed = m_target.key;
      m_hasTarget = false;
      m_count = 0;
    }
    if (m_hasTarget) {
      break;
    }
    const std::size_t next = after(m_passed);
    if (next == known) {
      break; // no target known: continue at this velocity
    }
    if (now - m_since > 1.) { // it continued for a while
      m_start = at(now);
      m_since = now;
    }
    m_target = targets[next];
    plan(m_pieces[0], m_start, m_target, m_since, durationTo(m_start, m_target));
    m_hasTarget = true;
    m_count = 1;
    m_output.newTarget = true;
  }
  if (m_hasTarget) {
    // Follow the measured position of the target, while there is time.
    vpTrajectorySegment &piece = m_pieces[0];
    const double rest = piece.begin + piece.duration - now;
    m_output.frozen = rest < m_spec.freeze;
    for (std::size_t i = 0; i < known; ++i) {
      const vpPrintTarget &seen = targets[i];
      if (seen.key == m_target.key && isUsable(seen) && seen.position != m_target.position && !m_output.frozen) {
        m_target.position = seen.position;
        plan(piece, at(now), m_target, now, rest);
      }
    }
    // And the following targets, as far as they are known.
    m_count = 1;
    vpAxisState from{{m_target.position, m_target.velocity, 0., 0.}};
    for (std::size_t i = after(m_target.key); i < known && m_count < vpMotionForecast::maxPieces; ++i) {
      if (!isUsable(targets[i])) {
        continue;
      }
      const vpTrajectorySegment &last = m_pieces[static_cast<std::size_t>(m_count - 1)];
      plan(m_pieces[static_cast<std::size_t>(m_count)], from, targets[i], last.begin + last.duration,
           durationTo(from, targets[i]));
      from = {{targets[i].position, targets[i].velocity, 0., 0.}};
      ++m_count;
    }
    m_output.arrival = piece.begin + piece.duration;
    const double peak = piece.p.derivative().range().peak() / piece.duration;
    m_output.exceeded =
        m_spec.mode == vpPrintReferenceMode::LimitedVelocity && !(peak <= m_spec.maxVelocity * (1. + 1e-9));
  }
  m_output.hasTarget = m_hasTarget;
  m_output.target = m_target.key;
  const vpAxisState state = at(now);
  if (std::all_of(state.begin(), state.end(), [](double x) { return std::fabs(x) <= largestState; })) {
    m_output.state = state;
  }
  else { // targets much too far for their time: stay
    reset(now, m_output.state[0], m_passed);
    m_output.valid = false;
  }
  return m_output;
}

END_VISP_NAMESPACE
