/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTailProbability.h
 * \brief How unlikely a sum of squares is when a fit is right.
 */
#ifndef vpTailProbability_h
#define vpTailProbability_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_direct_core
 * Probability that a chi-square variable is at least \e value: the sum of squares of a fit whose deviations are known.
 * \param value : Sum of squares, >= 0, in standard deviations squared. \param degrees : Of freedom, > 0.
 * \return In [0, 1]; 0 for infinity, NaN for NaN or what is out of range.
 */
[[nodiscard]] VISP_EXPORT double vpChiSquareTail(double value, double degrees) noexcept;

/*!
 * \ingroup group_direct_core
 * Probability that a variable with Fisher's distribution is at least \e ratio: of two mean sums of squares whose common
 * deviation is not known.
 * \param ratio : Mean square above, over mean square below, >= 0. \param above, below : Their degrees of freedom, > 0.
 * \return In [0, 1]; 0 for infinity, NaN for NaN or what is out of range.
 */
[[nodiscard]] VISP_EXPORT double vpFisherTail(double ratio, double above, double below) noexcept;

END_VISP_NAMESPACE
#endif
