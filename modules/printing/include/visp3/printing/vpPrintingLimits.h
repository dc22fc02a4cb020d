/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintingLimits.h
 * \brief Range of valid numbers for the steps of this module.
 */
#ifndef vpPrintingLimits_h
#define vpPrintingLimits_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief Largest valid magnitude of a time, position, velocity, acceleration, force or deviation, in any unit: larger
 * numbers are errors, and within it no square or product overflows. Deviations are also at least 1 / vpPrintingLargest.
 */
constexpr double vpPrintingLargest = 1e12;

//! \ingroup group_printing
//! \brief True for |x| <= vpPrintingLargest; false for NaN.
[[nodiscard]] inline bool vpIsPlausible(double x) noexcept { return std::fabs(x) <= vpPrintingLargest; }

//! \ingroup group_printing
//! \brief True for a standard deviation that is plausible and > 0.
[[nodiscard]] inline bool vpIsPlausibleDeviation(double x) noexcept
{
  return x >= 1. / vpPrintingLargest && x <= vpPrintingLargest;
}

END_VISP_NAMESPACE
#endif
