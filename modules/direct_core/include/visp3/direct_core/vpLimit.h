/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpLimit.h
 * \brief Tolerance within which a value counts as on its limit rather than beyond it.
 */
#ifndef vpLimit_h
#define vpLimit_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_direct_core
 * \brief One tolerance for the limits of all modules.
 *
 * Limits and values may come from files, floats or sums; pi as a float is 8.7e-8 above pi as a double.
 * A value that exceeds its limit by at most one millionth counts as on the limit. NaN never does.
 *
 * \code
 * const double high = 3.14159265; // rad, as read from a file
 * if (vpLimit::isBetween(-high, M_PI, high)) {
 *   std::cout << "on its limit" << std::endl; // beyond it by less than a millionth
 * }
 * \endcode
 */
namespace vpLimit
{
constexpr double tolerance = 1e-6; //!< Relative tolerance; a few float steps of up to 1.2e-7.
constexpr double smallest = 1e-12; //!< Absolute tolerance for a limit of zero, in its unit.

//! Absolute tolerance of a limit; 0 for an infinite limit.
[[nodiscard]] inline double slack(double limit)
{
  return std::isfinite(limit) ? (limit != 0. ? tolerance * std::abs(limit) : smallest) : 0.;
}

//! True when value <= limit, within the tolerance.
[[nodiscard]] inline bool isBelow(double value, double limit) { return value <= limit + slack(limit); }

//! True when low <= value <= high, within the tolerance.
[[nodiscard]] inline bool isBetween(double low, double value, double high)
{
  return value >= low - slack(low) && isBelow(value, high);
}
} // namespace vpLimit

END_VISP_NAMESPACE
#endif
