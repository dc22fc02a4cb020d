/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTailProbability.h
 * \brief Tail probabilities for testing the goodness of a fit.
 */
#ifndef vpTailProbability_h
#define vpTailProbability_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_direct_core
 * Probability that a chi-square variable is at least \e value: test of a fit with known standard deviations.
 *
 * \code
 * const double squares = 31.4; // of 12 residuals, each over its standard deviation; 2 parameters were fitted
 * if (vpChiSquareTail(squares, 12. - 2.) < 0.01) {
 *   std::cout << "not noise alone" << std::endl; // the probability is 0.0005
 * }
 * \endcode
 * \param value : Sum of squares, >= 0, in standard deviations squared. \param degrees : Degrees of freedom, > 0.
 * \return In [0, 1]; 0 for infinity, NaN for NaN or out-of-range input.
 */
[[nodiscard]] VISP_EXPORT double vpChiSquareTail(double value, double degrees) noexcept;

/*!
 * \ingroup group_direct_core
 * Probability that a variable with Fisher's (F) distribution is at least \e ratio: test of two mean squares whose
 * common standard deviation is not known.
 * \param ratio : Numerator mean square over denominator mean square, >= 0.
 * \param above, below : Their degrees of freedom, > 0.
 * \return In [0, 1]; 0 for infinity, NaN for NaN or out-of-range input.
 */
[[nodiscard]] VISP_EXPORT double vpFisherTail(double ratio, double above, double below) noexcept;

END_VISP_NAMESPACE
#endif
