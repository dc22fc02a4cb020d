/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpGoalJitter.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Duration of the rest-to-rest quintic over h that just keeps the limits.
double restDuration(double h, double velocity, double acceleration, double jerk)
{
  return std::max(
      {15. / 8. * h / velocity, std::sqrt(10. / std::sqrt(3.) * h / acceleration), std::cbrt(60. * h / jerk)});
}
} // namespace

vpGoalJitter::vpGoalJitter(int axes) : m_axes(static_cast<std::size_t>(std::max(axes, 0))) {}

void vpGoalJitter::reset() noexcept { std::fill(m_axes.begin(), m_axes.end(), Axis()); }

void vpGoalJitter::pass(double dt) noexcept
{
  const double fade = std::exp(-dt / memory);
  for (Axis &axis : m_axes) {
    axis.level *= fade;
  }
}

void vpGoalJitter::see(int axis, double surprise) noexcept
{
  if (!std::isfinite(surprise)) {
    return;
  }
  Axis &a = m_axes[static_cast<std::size_t>(axis)];
  if ((surprise < 0.) != (a.last < 0.)) {
    a.level = std::max(a.level, std::min(std::abs(surprise), std::abs(a.last)));
  }
  a.last = surprise;
}

double vpGoalJitter::level(int axis) const { return m_axes[static_cast<std::size_t>(axis)].level; }

double vpGoalJitter::floor(const vpTrajectoryProblem &problem) const noexcept
{
  double least = 0.;
  for (int i = 0; i < problem.axes(); ++i) {
    const vpAxisLimits limits = problem.limits(i);
    least = std::max(least, restDuration(level(i), limits.velocity, limits.acceleration, limits.jerk));
  }
  for (const vpAxisGroup &group : problem.spec.groups) {
    double norm = 0.;
    for (int i = 0; i < problem.axes(); ++i) {
      norm = group.contains(i) ? std::hypot(norm, level(i)) : norm;
    }
    least = norm > 0. ? std::max(least, restDuration(norm, group.maxSpeed, group.maxAcceleration,
                                                     std::numeric_limits<double>::infinity()))
                      : least;
  }
  return ease * least;
}

END_VISP_NAMESPACE
