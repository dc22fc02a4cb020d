/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

BEGIN_VISP_NAMESPACE

double vpQuantileInPlace(double *begin, double *end, double share) noexcept
{
  if (begin == end || std::isnan(share)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double place = std::clamp(share, 0., 1.) * static_cast<double>(end - begin - 1);
  const double below = std::floor(place);
  double *const low = begin + static_cast<std::ptrdiff_t>(below);
  std::nth_element(begin, low, end);
  const double rest = place - below;
  if (rest == 0.) { // also avoids 0 * inf
    return *low;
  }
  const double high = *std::min_element(low + 1, end);
  return *low == high ? high : (1. - rest) * *low + rest * high;
}

double vpQuantile(std::vector<double> values, double share)
{
  return vpQuantileInPlace(values.data(), values.data() + values.size(), share);
}

double vpMedian(std::vector<double> values) { return vpQuantile(std::move(values), 0.5); }

END_VISP_NAMESPACE
