/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpTailProbability.h>

#include <unsupported/Eigen/SpecialFunctions>

#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

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

END_VISP_NAMESPACE
