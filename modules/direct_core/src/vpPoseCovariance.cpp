/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpPoseCovariance.h>

#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

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
