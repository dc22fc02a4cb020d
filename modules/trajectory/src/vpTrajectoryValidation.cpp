/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Validation of a problem, all in one place so that planning can rely on it.
#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <visp3/direct_core/vpLimit.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
vpTrajectoryStatus fault(vpTrajectoryFault what, int index, double value)
{
  return {vpTrajectoryResult::InvalidInput, what, index, value};
}

vpTrajectoryStatus outside(vpTrajectoryFault what, double value, const vpLimitExcess &excess)
{
  return {vpTrajectoryResult::InvalidInput, what, excess.index, value, excess};
}

constexpr vpTrajectoryStatus good{vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};

// Beyond these, powers of a duration leave the range of a double.
constexpr double largest = 1e12;
constexpr double smallestLimit = 1e-12;
constexpr double shortestArrival = 1e-9;

bool isDuration(double t) { return t >= 0. && t <= largest; }
bool isLimit(double limit) { return limit >= smallestLimit && (limit <= largest || std::isinf(limit)); }
bool isPositionLimit(double limit) { return std::abs(limit) <= largest || std::isinf(limit); }
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
  return good;
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
    if (!isLimit(limit)) {
      return fault(vpTrajectoryFault::OutOfRange, i, limit);
    }
  }
  if (!std::isfinite(v) && !std::isfinite(a) && spec.policy != vpReplanPolicy::FixedArrival) {
    return fault(vpTrajectoryFault::NoLimit, i, v);
  }
  const double low = at(MinPosition, i), high = at(MaxPosition, i);
  if (!(low < high)) {
    return fault(vpTrajectoryFault::PositionLimits, i, high);
  }
  for (double limit : {low, high}) {
    if (!isPositionLimit(limit)) {
      return fault(vpTrajectoryFault::OutOfRange, i, limit);
    }
  }
  if (!vpLimit::isBelow(to[0], high)) {
    return outside(vpTrajectoryFault::GoalOutsidePosition, to[0], {vpTrajectoryLimit::MaxPosition, i, to[0], high});
  }
  if (!vpLimit::isBelow(-to[0], -low)) {
    return outside(vpTrajectoryFault::GoalOutsidePosition, to[0], {vpTrajectoryLimit::MinPosition, i, to[0], low});
  }
  if (!vpLimit::isBelow(std::abs(to[1]), v)) {
    return outside(vpTrajectoryFault::GoalOutsideVelocity, to[1], {vpTrajectoryLimit::Velocity, i, std::abs(to[1]), v});
  }
  if (spec.continuity != vpTrajectoryContinuity::C1 && !vpLimit::isBelow(std::abs(to[2]), a)) {
    return outside(vpTrajectoryFault::GoalOutsideAcceleration, to[2],
                   {vpTrajectoryLimit::Acceleration, i, std::abs(to[2]), a});
  }
  if (spec.continuity == vpTrajectoryContinuity::C3 && !vpLimit::isBelow(std::abs(to[3]), j)) {
    return outside(vpTrajectoryFault::GoalOutsideJerk, to[3], {vpTrajectoryLimit::Jerk, i, std::abs(to[3]), j});
  }
  return good;
}

vpTrajectoryStatus vpTrajectoryProblem::validateGroups() const noexcept
{
  std::uint64_t used = 0;
  for (int g = 0; g < vpTrajectorySpec::maxGroups; ++g) {
    const vpAxisGroup &group = spec.groups[static_cast<std::size_t>(g)];
    if (group.axes == 0) {
      continue;
    }
    if (!(group.maxSpeed > 0.) || !(group.maxAcceleration > 0.)) {
      return fault(vpTrajectoryFault::GroupLimit, g, !(group.maxSpeed > 0.) ? group.maxSpeed : group.maxAcceleration);
    }
    if (!isLimit(group.maxSpeed) || !isLimit(group.maxAcceleration)) {
      return fault(vpTrajectoryFault::GroupLimit, g, !isLimit(group.maxSpeed) ? group.maxSpeed : group.maxAcceleration);
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
    if (!vpLimit::isBelow(std::sqrt(v2), group.maxSpeed)) {
      return outside(vpTrajectoryFault::GoalOutsideGroup, std::sqrt(v2),
                     {vpTrajectoryLimit::GroupSpeed, g, std::sqrt(v2), group.maxSpeed});
    }
    if (!vpLimit::isBelow(std::sqrt(a2), group.maxAcceleration)) {
      return outside(vpTrajectoryFault::GoalOutsideGroup, std::sqrt(a2),
                     {vpTrajectoryLimit::GroupAcceleration, g, std::sqrt(a2), group.maxAcceleration});
    }
  }
  return good;
}

vpTrajectoryStatus vpTrajectoryProblem::validateVias() const noexcept
{
  if (m_vias > m_maxVias || m_vias < 0) {
    return fault(vpTrajectoryFault::TooManyVias, m_maxVias, m_vias);
  }
  if (m_vias > 0 && spec.continuity != vpTrajectoryContinuity::C2) {
    return fault(vpTrajectoryFault::ViaContinuity, m_vias - 1,
                 spec.continuity == vpTrajectoryContinuity::C1 ? 1. : 3.);
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
        if (std::abs(value) > largest) {
          return fault(vpTrajectoryFault::ViaOutsideLimits, k, value);
        }
      }
      if (!vpLimit::isBetween(at(MinPosition, i), x[0], at(MaxPosition, i))) {
        return fault(vpTrajectoryFault::ViaOutsideLimits, k, x[0]);
      }
      if (!vpLimit::isBelow(std::abs(x[1]), at(MaxVelocity, i))) {
        return fault(vpTrajectoryFault::ViaOutsideLimits, k, x[1]);
      }
      if (!vpLimit::isBelow(std::abs(x[2]), at(MaxAcceleration, i))) {
        return fault(vpTrajectoryFault::ViaOutsideLimits, k, x[2]);
      }
    }
  }
  return good;
}

vpTrajectoryStatus vpTrajectoryProblem::validateOptions() const noexcept
{
  const vpTrajectorySpec &o = spec;
  if (o.policy == vpReplanPolicy::FixedArrival && !(o.arrivalTime >= shortestArrival && o.arrivalTime <= largest)) {
    return fault(vpTrajectoryFault::ArrivalTime, -1, o.arrivalTime);
  }
  for (double t : {o.minimumDuration, o.freeze, o.replanPeriod}) {
    if (!isDuration(t)) {
      return fault(vpTrajectoryFault::Duration, -1, t);
    }
  }
  for (double gain : {o.thesisVelocityGain, o.thesisAccelerationGain}) {
    if (!isLimit(gain) || std::isinf(gain)) {
      return fault(vpTrajectoryFault::ThesisGain, -1, gain);
    }
  }
  if (o.thesisStepsPerCycle < 1) {
    return fault(vpTrajectoryFault::ThesisSteps, -1, o.thesisStepsPerCycle);
  }
  return good;
}

END_VISP_NAMESPACE
