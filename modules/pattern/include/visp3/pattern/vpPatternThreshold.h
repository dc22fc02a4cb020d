/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPatternThreshold.h
 * \brief Thresholds of table 7.1, computed from a histogram.
 *
 * ViSP's autoThreshold() has Otsu and Isodata too, but allocates and overwrites the image, and has no minimum error.
 */
#ifndef vpPatternThreshold_h
#define vpPatternThreshold_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <cstdint>

BEGIN_VISP_NAMESPACE

//! \ingroup group_pattern
//! \brief Method that divides the image into bright and dark.
enum class vpPatternThreshold {
  Otsu,        //!< Maximum variance between the classes \cite Otsu79.
  Isodata,     //!< Mean of the class means, iterated \cite Ridler78.
  MinimumError //!< Two normal distributions of minimum classification error \cite Kittler86.
};

//! \ingroup group_pattern
//! \brief Number of pixels of each grey value.
using vpPatternHistogram = std::array<std::uint32_t, 256>;

//! \ingroup group_pattern
//! \brief A threshold and its separability.
struct VISP_EXPORT vpPatternThresholdResult {
  int threshold = -1;       //!< Values above it are bright; 0 to 254. -1: none, because all pixels have the same value.
  double separability = 0.; //!< Variance between the classes over the total variance, 0 to 1 (noise alone: about 0.64).
  double darkMean = 0.;     //!< Mean of the values up to the threshold, 0 to 255.
  double brightMean = 0.;   //!< Mean of the values above the threshold, 0 to 255.
};

/*!
 * \ingroup group_pattern
 * \brief Threshold of a histogram, thesis table 7.1. Allocates nothing; an empty histogram has the threshold -1.
 *
 * \code
 * vpPatternHistogram histogram{};
 * for (unsigned int i = 0; i < image.getSize(); ++i) {
 *   ++histogram[image.bitmap[i]];
 * }
 * const vpPatternThresholdResult found = vpFindThreshold(histogram, vpPatternThreshold::Otsu);
 * if (found.threshold >= 0 && found.separability > 0.8) { // noise alone: 0.64
 *   std::cout << "bright above " << found.threshold << std::endl;
 * }
 * \endcode
 */
[[nodiscard]] VISP_EXPORT vpPatternThresholdResult vpFindThreshold(const vpPatternHistogram &histogram,
                                                                   vpPatternThreshold method);

//! \ingroup group_pattern
//! \brief The method as a word ("Otsu"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpPatternThreshold method);

END_VISP_NAMESPACE
#endif
