/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpPoseCovariance.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpTailProbability.h>

#include <unsupported/Eigen/SpecialFunctions>

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

double vpChiSquareTail(double value, double degrees) noexcept
{
  if (!(value >= 0. && degrees > 0. && std::isfinite(degrees))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::isinf(value) ? 0. : Eigen::numext::igammac(0.5 * degrees, 0.5 * value);
}

double vpFisherTail(double ratio, double above, double below) noexcept
{
  if (!(ratio >= 0. && above > 0. && below > 0. && std::isfinite(above) && std::isfinite(below))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double share = below / (below + above * ratio); // 0 for infinity
  return Eigen::numext::betainc(0.5 * below, 0.5 * above, share);
}

namespace
{
// A negative or NaN trace counts as unknown.
double deviation(bool known, double trace)
{
  return known && trace >= 0. ? std::sqrt(trace) : std::numeric_limits<double>::infinity();
}
} // namespace

double vpPoseCovariance::positionDeviation() const
{
  const vpPoseCovariance &c = *this;
  return deviation(known, c(0, 0) + c(1, 1) + c(2, 2));
}

double vpPoseCovariance::rotationDeviation() const
{
  const vpPoseCovariance &c = *this;
  return deviation(known, c(3, 3) + c(4, 4) + c(5, 5));
}

END_VISP_NAMESPACE
