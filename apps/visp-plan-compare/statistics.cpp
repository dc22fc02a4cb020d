/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "statistics.h"

#include <algorithm>
#include <cmath>

namespace planCompare
{
Interval wilson(int successes, int total)
{
  if (total <= 0) {
    return {};
  }
  constexpr double z = 1.959963984540054; // 97.5 % of the normal distribution
  const double n = total, p = successes / n, z2 = z * z;
  const double centre = (p + 0.5 * z2 / n) / (1. + z2 / n);
  const double half = z / (1. + z2 / n) * std::sqrt(p * (1. - p) / n + 0.25 * z2 / (n * n));
  return {successes == 0 ? 0. : centre - half, successes == total ? 1. : centre + half};
}

double mcNemar(int onlyFirst, int onlySecond)
{
  const int n = onlyFirst + onlySecond, few = std::min(onlyFirst, onlySecond);
  double p = 0.;
  for (int k = 0; k <= few; ++k) {
    p += std::exp(std::lgamma(n + 1.) - std::lgamma(k + 1.) - std::lgamma(n - k + 1.) - n * std::log(2.));
  }
  return std::min(1., 2. * p);
}
} // namespace planCompare
