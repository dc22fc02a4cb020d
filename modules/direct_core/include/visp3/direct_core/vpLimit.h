/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpLimit.h
 * \brief When a given number counts as being on its limit rather than beyond it.
 */
#ifndef vpLimit_h
#define vpLimit_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_direct_core
 * \brief One tolerance for all given limits of all modules.
 *
 * Limits and values come from files, from single precision and from sums; pi as a float is 8.7e-8 above pi as a double.
 * A value that exceeds its limit by no more than a millionth counts as being on it. NaN never does.
 */
namespace vpLimit
{
constexpr double tolerance = 1e-6; //!< Relative to the limit; some steps of a float, which are up to 1.2e-7.
constexpr double smallest = 1e-12; //!< The same for a limit of zero, in its unit.

//! What counts as being on a limit: its tolerance, 0 for an infinite limit.
[[nodiscard]] inline double slack(double limit)
{
  return std::isfinite(limit) ? std::max(tolerance * std::abs(limit), smallest) : 0.;
}

//! True when value <= limit, or above it within the tolerance.
[[nodiscard]] inline bool isBelow(double value, double limit) { return value <= limit + slack(limit); }

//! True when low <= value <= high, or outside within the tolerance.
[[nodiscard]] inline bool isBetween(double low, double value, double high)
{
  return value >= low - slack(low) && isBelow(value, high);
}
} // namespace vpLimit

END_VISP_NAMESPACE
#endif
