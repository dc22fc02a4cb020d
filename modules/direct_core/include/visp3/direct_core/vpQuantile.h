/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpQuantile.h
 * \brief Medians and percentiles, with one definition for all of visp-direct.
 */
#ifndef vpQuantile_h
#define vpQuantile_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_direct_core
 * Quantile of a sample: linear interpolation between the order statistics at index share (n - 1), from 0. Same
 * definition as NumPy, R (type 7) and spreadsheets: the median of 1..10 is 5.5.
 *
 * \code
 * const std::vector<double> times = {4.1, 3.9, 4., 4.2, 9.}; // ms
 * std::cout << "median " << vpMedian(times) << " ms, 95 % below " << vpQuantile(times, 0.95) << " ms\n"; // 4.1, 8.04
 * \endcode
 * \param values : The sample, in any order, without NaN; infinities are ordinary values.
 * \param share : 0 for the minimum, 0.5 for the median, 1 for the maximum; values outside [0, 1] are clamped.
 * \return The quantile; NaN when the sample is empty or \e share is NaN.
 */
[[nodiscard]] VISP_EXPORT double vpQuantile(std::vector<double> values, double share);

//! \ingroup group_direct_core
//! Median: vpQuantile() at 0.5.
[[nodiscard]] VISP_EXPORT double vpMedian(std::vector<double> values);

/*!
 * \ingroup group_direct_core
 * vpQuantile() of the values in [begin, end) without allocation, for control loops; reorders the values.
 */
[[nodiscard]] VISP_EXPORT double vpQuantileInPlace(double *begin, double *end, double share) noexcept;

END_VISP_NAMESPACE
#endif
