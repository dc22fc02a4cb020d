/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLimitCheck.h"

#include "vpAxisForms.h"
#include "vpRootKernel.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpTrajectoryLimit axisLimits[] = {vpTrajectoryLimit::MinPosition, vpTrajectoryLimit::MaxPosition,
                                            vpTrajectoryLimit::Velocity, vpTrajectoryLimit::Acceleration,
                                            vpTrajectoryLimit::Jerk};

int derivativeOf(vpTrajectoryLimit limit)
{
  return limit == vpTrajectoryLimit::Velocity       ? 1
         : limit == vpTrajectoryLimit::Acceleration ? 2
         : limit == vpTrajectoryLimit::Jerk         ? 3
                                                    : 0;
}

double boundOf(const vpAxisLimits &limits, vpTrajectoryLimit limit)
{
  switch (limit) {
  case vpTrajectoryLimit::MinPosition:
    return limits.minPosition;
  case vpTrajectoryLimit::MaxPosition:
    return limits.maxPosition;
  case vpTrajectoryLimit::Velocity:
    return limits.velocity;
  case vpTrajectoryLimit::Acceleration:
    return limits.acceleration;
  default:
    return limits.jerk;
  }
}

double power(double x, int n)
{
  double p = 1.;
  for (int i = 0; i < n; ++i) {
    p *= x;
  }
  return p;
}
} // namespace

vpTrajectoryStatus vpLimitCheck::judge(double groupBraking, double &brakingEnd) const noexcept
{
  brakingEnd = 0.;
  vpTrajectoryStatus status{vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
  status.excess = worst(0., Wanted::All, false);
  if (status.excess.limit == vpTrajectoryLimit::None) {
    return status;
  }
  bool outside = groupBraking > 0.;
  double inside = groupBraking;
  for (int axis = 0; axis < m_plan.axes(); ++axis) {
    if (anyStartsOutside(axis)) {
      outside = true;
      for (const vpTrajectoryLimit limit : axisLimits) {
        inside = startsOutside(axis, limit) ? std::max(inside, excursionEnd(axis, limit)) : inside;
      }
    }
  }
  if (outside) {
    brakingEnd = inside;
    const vpLimitExcess early = worst(0., Wanted::Unexplained, groupBraking > 0.);
    const vpLimitExcess later = worst(inside * (1. + 1e-12), Wanted::All, false);
    if (early.limit == vpTrajectoryLimit::None && later.limit == vpTrajectoryLimit::None) {
      status.result = vpTrajectoryResult::Braking;
      status.fault = vpTrajectoryFault::StartOutsideLimits;
      return status;
    }
    status.excess = early.limit != vpTrajectoryLimit::None ? early : later;
  }
  status.result = vpTrajectoryResult::NoFeasibleDuration;
  status.fault = vpTrajectoryFault::LimitExceeded;
  return status;
}

vpLimitExcess vpLimitCheck::worst(double from, Wanted wanted, bool groupsBrake) const noexcept
{
  Worst worst;
  for (int axis = 0; axis < m_plan.axes(); ++axis) {
    checkAxis(axis, from, wanted, worst);
  }
  if (!groupsBrake) {
    checkGroups(from, worst);
  }
  return worst.excess;
}

void vpLimitCheck::checkAxis(int axis, double from, Wanted wanted, Worst &worst) const noexcept
{
  const vpAxisLimits limits = m_problem.limits(axis);
  const bool jerk = std::isfinite(limits.jerk) && m_problem.spec.continuity != vpTrajectoryContinuity::C1;
  // Positions are rounded relative to the largest of them.
  const double place = std::max(std::abs(m_problem.start(axis)[0]), std::abs(m_problem.goal(axis)[0]));
  const double most[] = {limits.maxPosition, limits.velocity, limits.acceleration, limits.jerk};
  const double least[] = {limits.minPosition, -limits.velocity, -limits.acceleration, -limits.jerk};
  const int count = m_plan.segments(axis) + m_plan.coasting(axis);
  for (int i = 0; i < count; ++i) {
    const vpTrajectorySegment &segment = m_plan.segment(axis, i);
    const double first = (from - segment.begin) / segment.duration;
    if (first >= 1.) {
      continue;
    }
    double c[vpMotionFamily::maxDegree + 1];
    int degree = std::min(segment.p.degree(), vpMotionFamily::maxDegree);
    std::copy_n(segment.p.data(), degree + 1, c);
    double unit = 1.;
    for (int d = 0; d <= (jerk ? 3 : 2) && degree >= 0; ++d) {
      if (d > 0) {
        vpRootKernel::differentiate(c, degree--, c);
        unit *= segment.duration;
      }
      if (degree < 0) {
        break;
      }
      if (!std::isfinite(most[d]) && !std::isfinite(least[d])) {
        continue;
      }
      double low = 0., high = 0.;
      bool exact = false;
      vpRootKernel::enclose(c, degree, low, high);
      const double slack = d > 0 ? 1. + 0.5 * precision : 1.;
      if (low >= slack * least[d] * unit && high <= slack * most[d] * unit) {
        continue;
      }
      const auto consider = [&](vpTrajectoryLimit limit, bool upper) {
        const double bound = boundOf(limits, limit);
        if (!std::isfinite(bound) || (wanted == Wanted::Unexplained && startsOutside(axis, limit))) {
          return;
        }
        const double scale = d == 0 ? std::max(place, std::abs(bound)) : bound;
        const auto relative = [&] {
          const double value = (upper ? high : low) / unit;
          const double beyond = upper ? value - bound : (d == 0 ? bound : -bound) - value;
          return beyond / scale;
        };
        if (relative() <= worst.relative) {
          return;
        }
        if (!exact) {
          vpRootKernel::extremes(c, degree, std::max(first, 0.), low, high);
          exact = true;
        }
        if (!(relative() <= worst.relative)) {
          worst.relative = relative();
          worst.excess = {limit, axis, d > 0 && !upper ? -low / unit : (upper ? high : low) / unit, bound};
        }
      };
      if (d == 0) {
        consider(vpTrajectoryLimit::MaxPosition, true);
        consider(vpTrajectoryLimit::MinPosition, false);
      }
      else {
        consider(axisLimits[d + 1], true);
        consider(axisLimits[d + 1], false);
      }
    }
  }
}

void vpLimitCheck::checkGroups(double from, Worst &worst) const noexcept
{
  for (int g = 0; g < vpTrajectorySpec::maxGroups; ++g) {
    const vpNormLimits limits = m_problem.groupLimits(g);
    const std::uint64_t axes = m_problem.spec.groups[static_cast<std::size_t>(g)].axes;
    for (int order = 1; order <= 2 && axes != 0; ++order) {
      const double bound = order == 1 ? limits.velocity : limits.acceleration;
      if (!std::isfinite(bound)) {
        continue;
      }
      const double value = m_plan.peakNorm(axes, order, from);
      if (!(value / bound - 1. <= worst.relative)) {
        worst.relative = value / bound - 1.;
        worst.excess = {order == 1 ? vpTrajectoryLimit::GroupSpeed : vpTrajectoryLimit::GroupAcceleration, g, value,
                        bound};
      }
    }
  }
}

// The start is beyond this limit of its axis, or cannot avoid exceeding it: the excess is not due to the planner.
bool vpLimitCheck::startsOutside(int axis, vpTrajectoryLimit limit) const noexcept
{
  const vpAxisLimits limits = m_problem.limits(axis);
  vpAxisTask task;
  task.from = m_problem.start(axis);
  if (limit == vpTrajectoryLimit::MinPosition) {
    return task.from[0] < limits.minPosition;
  }
  if (limit == vpTrajectoryLimit::MaxPosition) {
    return task.from[0] > limits.maxPosition;
  }
  task.limits = limits;
  task.order = 2 + static_cast<int>(m_problem.spec.continuity);
  return needsBraking(task);
}

bool vpLimitCheck::anyStartsOutside(int axis) const noexcept
{
  return startsOutside(axis, vpTrajectoryLimit::MinPosition) || startsOutside(axis, vpTrajectoryLimit::MaxPosition) ||
         startsOutside(axis, vpTrajectoryLimit::Velocity);
}

// Until the end of the first interval beyond a limit.
double vpLimitCheck::excursionEnd(int axis, vpTrajectoryLimit limit) const noexcept
{
  const vpAxisLimits limits = m_problem.limits(axis);
  const int d = derivativeOf(limit);
  const double sides[] = {1., -1.};
  double end = 0.;
  for (const double side : sides) {
    if ((limit == vpTrajectoryLimit::MinPosition && side > 0.) ||
        (limit == vpTrajectoryLimit::MaxPosition && side < 0.)) {
      continue;
    }
    const double bound = limit == vpTrajectoryLimit::MinPosition ? -limits.minPosition : boundOf(limits, limit);
    if (!std::isfinite(bound)) {
      continue;
    }
    bool seen = false, over = false;
    double last = 0.;
    for (int i = 0; i < m_plan.segments(axis) && !over; ++i) {
      const vpTrajectorySegment &segment = m_plan.segment(axis, i);
      vpPolynomial x = segment.p;
      for (int k = 0; k < d; ++k) {
        x = x.derivative();
      }
      for (int k = 0; k <= x.degree(); ++k) {
        x[k] *= side;
      }
      x[0] -= bound * power(segment.duration, d);
      const auto roots = x.roots();
      double from = 0.;
      for (int k = 0; k <= roots.count && !over; ++k) {
        const double to = k < roots.count ? roots.s[static_cast<std::size_t>(k)] : 1.;
        const bool outside = x.value(0.5 * (from + to)) > 0.;
        over = seen && !outside;
        seen = seen || outside;
        last = over ? last : segment.begin + to * segment.duration;
        from = to;
      }
    }
    end = seen ? std::max(end, last) : end;
  }
  return end;
}

END_VISP_NAMESPACE
