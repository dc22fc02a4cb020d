/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintingLimits.h
 * \brief Which numbers the steps of this module take for measurements.
 */
#ifndef vpPrintingLimits_h
#define vpPrintingLimits_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief Largest magnitude of a time, place, velocity, acceleration, force or deviation that a step takes, in any unit:
 * beyond it a number is a broken one, and no square or product of those within it overflows. Deviations are also at
 * least 1 / vpPrintingLargest.
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
