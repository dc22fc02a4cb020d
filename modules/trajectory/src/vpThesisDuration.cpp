/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpThesisDuration.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace vpThesisDuration
{
double extraTime(const vpMotionFamily &motion, const vpAxisLimits &limits, const Gains &gains, double T) noexcept
{
  const vpPolynomial v = motion.at(T).derivative();
  double extra = -T;
  if (std::isfinite(limits.velocity)) {
    extra = std::max(extra, gains.velocity * (v.range().peak() / T - limits.velocity));
  }
  if (std::isfinite(limits.acceleration)) {
    extra = std::max(extra, gains.acceleration * (v.derivative().range().peak() / (T * T) - limits.acceleration));
  }
  return extra;
}

vpDurationAnswer solve(const vpMotionFamily &motion, const vpAxisLimits &limits, const Gains &gains, double T,
                       int steps) noexcept
{
  vpDurationAnswer answer;
  answer.T = T;
  while (answer.iterations < steps) {
    ++answer.iterations;
    const double extra = extraTime(motion, limits, gains, answer.T);
    // Reducing T by more than half at once would leave the range in which (6.6) is meaningful.
    answer.T = std::max(answer.T + extra, 0.5 * answer.T);
    if (std::abs(extra) < 1e-10 * answer.T) {
      answer.kind = vpDurationAnswer::Kind::Found;
      break;
    }
  }
  return answer;
}
} // namespace vpThesisDuration

END_VISP_NAMESPACE
