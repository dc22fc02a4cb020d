/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What may be wrong with a problem, checked in one place so that planning can rely on it.
#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double slack = 1. + 1e-9; // a goal on its limit is not above it

vpTrajectoryStatus fault(vpTrajectoryFault what, int index, double value)
{
  return {vpTrajectoryResult::InvalidInput, what, index, value};
}

// Beyond these, powers of a duration leave the range of a double.
constexpr double largest = 1e12;
constexpr double smallestLimit = 1e-12;

bool isDuration(double t) { return t >= 0. && std::isfinite(t); }
} // namespace

vpTrajectoryStatus vpTrajectoryProblem::validate(bool startToo) const noexcept
{
  for (int i = 0; i < m_axes; ++i) {
    const vpAxisState from = start(i);
    for (double x : from) {
      if (startToo && !std::isfinite(x)) {
        return fault(vpTrajectoryFault::StartNotFinite, i, x);
      }
      if (startToo && std::abs(x) > largest) {
        return fault(vpTrajectoryFault::OutOfRange, i, x);
      }
    }
    const vpTrajectoryStatus status = validateAxis(i);
    if (!status.isGood()) {
      return status;
    }
  }
  for (const auto check : {&vpTrajectoryProblem::validateGroups, &vpTrajectoryProblem::validateVias,
                           &vpTrajectoryProblem::validateOptions}) {
    const vpTrajectoryStatus status = (this->*check)();
    if (!status.isGood()) {
      return status;
    }
  }
  return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
}

vpTrajectoryStatus vpTrajectoryProblem::validateAxis(int i) const noexcept
{
  const vpAxisState to = goal(i);
  for (double x : to) {
    if (!std::isfinite(x)) {
      return fault(vpTrajectoryFault::GoalNotFinite, i, x);
    }
    if (std::abs(x) > largest) {
      return fault(vpTrajectoryFault::OutOfRange, i, x);
    }
  }
  const double v = at(MaxVelocity, i), a = at(MaxAcceleration, i), j = at(MaxJerk, i);
  if (!(v > 0.)) {
    return fault(vpTrajectoryFault::VelocityLimit, i, v);
  }
  if (!(a > 0.)) {
    return fault(vpTrajectoryFault::AccelerationLimit, i, a);
  }
  if (!(j > 0.)) {
    return fault(vpTrajectoryFault::JerkLimit, i, j);
  }
  for (double limit : {v, a, j}) {
    if (limit < smallestLimit || (limit > largest && std::isfinite(limit))) {
      return fault(vpTrajectoryFault::OutOfRange, i, limit);
    }
  }
  if (!std::isfinite(v) && !std::isfinite(a) && options.policy != vpReplanPolicy::FixedArrival) {
    return fault(vpTrajectoryFault::NoLimit, i, v);
  }
  const double low = at(MinPosition, i), high = at(MaxPosition, i);
  if (!(low < high)) {
    return fault(vpTrajectoryFault::PositionLimits, i, high);
  }
  if (to[0] < low || to[0] > high) {
    return fault(vpTrajectoryFault::GoalOutsidePosition, i, to[0]);
  }
  if (std::abs(to[1]) > v * slack) {
    return fault(vpTrajectoryFault::GoalOutsideVelocity, i, to[1]);
  }
  if (options.continuity != vpTrajectoryContinuity::C1 && std::abs(to[2]) > a * slack) {
    return fault(vpTrajectoryFault::GoalOutsideAcceleration, i, to[2]);
  }
  return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
}

vpTrajectoryStatus vpTrajectoryProblem::validateGroups() const noexcept
{
  std::uint64_t used = 0;
  for (int g = 0; g < vpTrajectoryOptions::maxGroups; ++g) {
    const vpAxisGroup &group = options.groups[static_cast<std::size_t>(g)];
    if (group.axes == 0) {
      continue;
    }
    if (!(group.maxSpeed > 0.) || !(group.maxAcceleration > 0.)) {
      return fault(vpTrajectoryFault::GroupLimit, g, !(group.maxSpeed > 0.) ? group.maxSpeed : group.maxAcceleration);
    }
    double v2 = 0., a2 = 0.;
    for (int i = 0; i < 64; ++i) {
      if (!group.contains(i)) {
        continue;
      }
      if (i >= m_axes || (used >> i & 1) != 0) {
        return fault(vpTrajectoryFault::GroupAxis, g, i);
      }
      used |= std::uint64_t(1) << i;
      v2 += at(GoalV, i) * at(GoalV, i);
      a2 += at(GoalA, i) * at(GoalA, i);
    }
    if (std::sqrt(v2) > group.maxSpeed * slack || std::sqrt(a2) > group.maxAcceleration * slack) {
      return fault(vpTrajectoryFault::GoalOutsideGroup, g,
                   std::sqrt(v2) > group.maxSpeed * slack ? std::sqrt(v2) : std::sqrt(a2));
    }
  }
  return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
}

vpTrajectoryStatus vpTrajectoryProblem::validateVias() const noexcept
{
  if (m_vias > m_maxVias || m_vias < 0) {
    return fault(vpTrajectoryFault::TooManyVias, m_maxVias, m_vias);
  }
  if (m_vias > 0 && options.continuity != vpTrajectoryContinuity::C2) {
    return fault(vpTrajectoryFault::ViaContinuity, m_vias - 1,
                 options.continuity == vpTrajectoryContinuity::C1 ? 1. : 3.);
  }
  double before = 0.;
  for (int k = 0; k < m_vias; ++k) {
    const double tau = viaTime(k);
    if (!(tau > 0. && tau < 1.)) {
      return fault(vpTrajectoryFault::ViaTime, k, tau);
    }
    if (tau <= before) {
      return fault(vpTrajectoryFault::ViaOrder, k, tau);
    }
    before = tau;
    for (int i = 0; i < m_axes; ++i) {
      const vpAxisState x = viaState(k, i);
      for (double value : x) {
        if (!std::isfinite(value)) {
          return fault(vpTrajectoryFault::ViaNotFinite, k, value);
        }
      }
      if (x[0] < at(MinPosition, i) || x[0] > at(MaxPosition, i)) {
        return fault(vpTrajectoryFault::ViaOutsideLimits, k, x[0]);
      }
      if (std::abs(x[1]) > at(MaxVelocity, i) * slack) {
        return fault(vpTrajectoryFault::ViaOutsideLimits, k, x[1]);
      }
      if (std::abs(x[2]) > at(MaxAcceleration, i) * slack) {
        return fault(vpTrajectoryFault::ViaOutsideLimits, k, x[2]);
      }
    }
  }
  return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
}

vpTrajectoryStatus vpTrajectoryProblem::validateOptions() const noexcept
{
  const vpTrajectoryOptions &o = options;
  if (o.policy == vpReplanPolicy::FixedArrival && !(o.arrivalTime > 0. && std::isfinite(o.arrivalTime))) {
    return fault(vpTrajectoryFault::ArrivalTime, -1, o.arrivalTime);
  }
  for (double t : {o.minimumDuration, o.freeze, o.replanPeriod}) {
    if (!isDuration(t)) {
      return fault(vpTrajectoryFault::Duration, -1, t);
    }
  }
  for (double gain : {o.thesisVelocityGain, o.thesisAccelerationGain}) {
    if (!(gain > 0.) || !std::isfinite(gain)) {
      return fault(vpTrajectoryFault::ThesisGain, -1, gain);
    }
  }
  if (o.thesisStepsPerCycle < 1) {
    return fault(vpTrajectoryFault::ThesisSteps, -1, o.thesisStepsPerCycle);
  }
  return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
}

END_VISP_NAMESPACE
