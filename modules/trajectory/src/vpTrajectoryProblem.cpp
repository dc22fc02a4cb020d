/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpLimit.h>

#include <algorithm>
#include <cmath>
#include <cstring>

BEGIN_VISP_NAMESPACE

bool operator==(const vpTrajectorySpec &a, const vpTrajectorySpec &b)
{
  const auto sameGroup = [](const vpAxisGroup &x, const vpAxisGroup &y) {
    return x.axes == y.axes && x.maxSpeed == y.maxSpeed && x.maxAcceleration == y.maxAcceleration;
  };
  return a.continuity == b.continuity && a.policy == b.policy && a.synchronisation == b.synchronisation &&
         a.method == b.method && a.lateArrival == b.lateArrival && a.cruise == b.cruise && a.form == b.form &&
         a.arrivalTime == b.arrivalTime && a.minimumDuration == b.minimumDuration && a.freeze == b.freeze &&
         a.replanPeriod == b.replanPeriod && a.thesisVelocityGain == b.thesisVelocityGain &&
         a.thesisAccelerationGain == b.thesisAccelerationGain && a.thesisStepsPerCycle == b.thesisStepsPerCycle &&
         std::equal(a.groups.begin(), a.groups.end(), b.groups.begin(), sameGroup);
}

vpTrajectoryProblem::vpTrajectoryProblem(int axes, int maxVias) : m_axes(axes), m_maxVias(maxVias)
{
  if (axes < 1) {
    throw vpException(vpException::badValue, "a trajectory has %d axes, must be >= 1", axes);
  }
  if (maxVias < 0) {
    throw vpException(vpException::badValue, "a trajectory has room for %d vias, must be >= 0", maxVias);
  }
  const auto n = static_cast<std::size_t>(axes), vias = static_cast<std::size_t>(maxVias);
  m_values.assign(FieldCount * n, 0.);
  m_viaValues.assign(vias * 3 * n, 0.);
  m_viaTimes.assign(vias, 0.);
  m_viaOrders.assign(vias, 1);
  const double none = std::numeric_limits<double>::infinity();
  for (Field f : {MaxVelocity, MaxAcceleration, MaxJerk, MaxPosition}) {
    std::fill_n(field(f), axes, none);
  }
  std::fill_n(field(MinPosition), axes, -none);
}

void vpTrajectoryProblem::setVia(int k, double tau, const double *q, const double *v, const double *a)
{
  const auto n = static_cast<std::size_t>(m_axes);
  double *values = m_viaValues.data() + static_cast<std::size_t>(k) * 3 * n;
  m_viaTimes[static_cast<std::size_t>(k)] = tau;
  m_viaOrders[static_cast<std::size_t>(k)] = v == nullptr ? 1 : (a == nullptr ? 2 : 3);
  std::fill_n(values, 3 * n, 0.);
  std::copy_n(q, n, values);
  if (v != nullptr) {
    std::copy_n(v, n, values + n);
  }
  if (a != nullptr) {
    std::copy_n(a, n, values + 2 * n);
  }
}

void vpTrajectoryProblem::setViaTime(int k, double tau, int order)
{
  m_viaTimes[static_cast<std::size_t>(k)] = tau;
  m_viaOrders[static_cast<std::size_t>(k)] = order;
}

void vpTrajectoryProblem::setViaState(int k, int axis, const vpAxisState &x)
{
  double *values = m_viaValues.data() + k * 3 * m_axes + axis;
  for (std::size_t d = 0; d < 3; ++d) {
    values[static_cast<int>(d) * m_axes] = x[d];
  }
}

vpAxisState vpTrajectoryProblem::viaState(int k, int axis) const
{
  const double *values = m_viaValues.data() + k * 3 * m_axes + axis;
  return {values[0], values[m_axes], values[2 * m_axes], 0.};
}

void vpTrajectoryProblem::dropVias(int count, double done)
{
  count = std::min(count, m_vias);
  const auto first = static_cast<std::ptrdiff_t>(count);
  std::copy(m_viaTimes.begin() + first, m_viaTimes.end(), m_viaTimes.begin());
  std::copy(m_viaOrders.begin() + first, m_viaOrders.end(), m_viaOrders.begin());
  std::copy(m_viaValues.begin() + first * 3 * m_axes, m_viaValues.end(), m_viaValues.begin());
  m_vias -= count;
  for (int k = 0; k < m_vias; ++k) {
    double &tau = m_viaTimes[static_cast<std::size_t>(k)];
    tau = tau == vpAutomaticTau ? tau : (tau - done) / (1. - done);
  }
}

void vpTrajectoryProblem::takeTask(const vpTrajectoryProblem &other)
{
  m_values = other.m_values;
  spec = other.spec;
}

void vpTrajectoryProblem::setStart(int axis, const vpAxisState &x)
{
  for (int k = 0; k < 4; ++k) {
    field(static_cast<Field>(StartQ + k))[axis] = x[static_cast<std::size_t>(k)];
  }
}

vpAxisState vpTrajectoryProblem::start(int axis) const
{
  return {at(StartQ, axis), at(StartV, axis), at(StartA, axis), at(StartJ, axis)};
}

vpAxisState vpTrajectoryProblem::goal(int axis) const
{
  return {at(GoalQ, axis), at(GoalV, axis), at(GoalA, axis), at(GoalJ, axis)};
}

vpAxisLimits vpTrajectoryProblem::limits(int axis) const
{
  vpAxisLimits limits{at(MaxVelocity, axis), at(MaxAcceleration, axis), at(MaxJerk, axis), at(MinPosition, axis),
                      at(MaxPosition, axis)};
  const auto include = [&limits](const vpAxisState &x) {
    const auto widen = [](double &limit, double value) {
      if (value > limit && vpLimit::isBelow(value, limit)) {
        limit = value;
      }
    };
    widen(limits.velocity, std::abs(x[1]));
    widen(limits.acceleration, std::abs(x[2]));
    widen(limits.jerk, std::abs(x[3]));
    widen(limits.maxPosition, x[0]);
    limits.minPosition *= -1.;
    widen(limits.minPosition, -x[0]);
    limits.minPosition *= -1.;
  };
  include(start(axis));
  include(goal(axis));
  for (int k = 0; k < std::min(m_vias, m_maxVias); ++k) {
    include(viaState(k, axis));
  }
  return limits;
}

vpNormLimits vpTrajectoryProblem::groupLimits(int g) const
{
  const vpAxisGroup &group = spec.groups[static_cast<std::size_t>(g)];
  vpNormLimits limits{group.maxSpeed, group.maxAcceleration};
  double norms[4] = {0., 0., 0., 0.};
  constexpr Field fields[4] = {StartV, GoalV, StartA, GoalA};
  for (int i = 0; i < m_axes; ++i) {
    for (int k = 0; k < 4 && group.contains(i); ++k) {
      norms[k] = std::hypot(norms[k], at(fields[k], i));
    }
  }
  for (int k = 0; k < 4; ++k) {
    double &limit = k < 2 ? limits.velocity : limits.acceleration;
    limit = norms[k] > limit && vpLimit::isBelow(norms[k], limit) ? norms[k] : limit;
  }
  return limits;
}

bool vpTrajectoryProblem::sameVias(const vpTrajectoryProblem &other) const
{
  const auto bytes =
      static_cast<std::size_t>(std::min(m_vias, m_maxVias)) * 3 * static_cast<std::size_t>(m_axes) * sizeof(double);
  const auto count = static_cast<std::ptrdiff_t>(std::min(m_vias, m_maxVias));
  return m_axes == other.m_axes && m_vias == other.m_vias &&
         std::equal(m_viaTimes.begin(), m_viaTimes.begin() + count, other.m_viaTimes.begin()) &&
         std::equal(m_viaOrders.begin(), m_viaOrders.begin() + count, other.m_viaOrders.begin()) &&
         (bytes == 0 || std::memcmp(m_viaValues.data(), other.m_viaValues.data(), bytes) == 0);
}

bool vpTrajectoryProblem::sameTask(const vpTrajectoryProblem &other) const
{
  // Bitwise comparison, so that a NaN is not an event in every cycle.
  const std::size_t count = index(FieldCount, 0) - index(GoalQ, 0);
  return m_axes == other.m_axes && std::memcmp(field(GoalQ), other.field(GoalQ), count * sizeof(double)) == 0 &&
         spec == other.spec && sameVias(other);
}

// Validation of a problem, all in one place so that planning can rely on it.
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
    return fault(vpTrajectoryFault::ViaContinuity, m_vias - 1, spec.continuity == vpTrajectoryContinuity::C1 ? 1. : 3.);
  }
  double before = 0.;
  for (int k = 0; k < m_vias; ++k) {
    const double tau = viaTime(k);
    if (hasAutomaticVias() ? tau != vpAutomaticTau : !(tau > 0. && tau < 1.)) {
      return fault(vpTrajectoryFault::ViaTime, k, tau);
    }
    if (!hasAutomaticVias() && tau <= before) {
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
