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
         a.method == b.method && a.lateArrival == b.lateArrival && a.cruise == b.cruise &&
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
    tau = (tau - done) / (1. - done);
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

END_VISP_NAMESPACE
