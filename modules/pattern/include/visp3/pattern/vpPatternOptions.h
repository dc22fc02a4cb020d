/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPatternOptions.h
 * \brief What a vpPatternTracker may be told; nothing needs to be.
 */
#ifndef vpPatternOptions_h
#define vpPatternOptions_h

#include <visp3/pattern/vpPatternThreshold.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_pattern
//! \brief How the centre of a cell is measured.
enum class vpPatternMethod {
  GaussNewton,         //!< Learned template, aligned with the image; the others are baselines to compare with.
  HalfMaximumEdges,    //!< Where the grey value crosses the threshold, on all four sides.
  ThesisAlgorithm,     //!< Algorithm 7.4 as printed: +0.5 px in x, and x no finer than the bounding box.
  ThesisAlgorithmFixed //!< Algorithm 7.4 with (7.12) corrected and sub-pixel edges on all four sides.
};

//! \ingroup group_pattern
//! \brief Derivative of table 7.2, for the two variants of Algorithm 7.4.
enum class vpPatternDerivative {
  Symmetric, //!< 3 x 1, I(y + 1) - I(y - 1).
  Roberts,   //!< 2 x 1, I(y + 1) - I(y); taken at y + 0.5.
  Prewitt,   //!< 3 x 3, mean over three lines.
  Sobel      //!< 3 x 3, weights 1 2 1.
};

//! \ingroup group_pattern
//! \brief Which of the two grey classes is the cell.
enum class vpPatternPolarity {
  Automatic, //!< The one that makes a lattice of equal spots; bright is tried first.
  Bright,    //!< Bright cells on a dark ground.
  Dark       //!< Dark cells on a bright ground.
};

/*!
 * \ingroup group_pattern
 * \brief Options of vpPatternTracker. The defaults suit every pattern that shows two periods each way.
 */
struct VISP_EXPORT vpPatternOptions {
  vpPatternMethod method = vpPatternMethod::GaussNewton;           //!< How a centre is measured.
  vpPatternThreshold threshold = vpPatternThreshold::Otsu;         //!< For the acquisition and the baselines.
  vpPatternDerivative derivative = vpPatternDerivative::Symmetric; //!< For the two variants of Algorithm 7.4.
  vpPatternPolarity polarity = vpPatternPolarity::Automatic;       //!< Which grey class is the cell.
  double minContrast = 12.; //!< Least difference of the two grey classes, grey values, in [1, 255].
  double minPitch = 6.;     //!< Least distance of neighbouring cells, px, in [4, 1000]; sets how much room is made.
  int learningFrames = 16;  //!< Frames from which the template is learned, three times over, in [2, 10000].
  int phasesPerFrame =
      2; //!< Sub-pixel phases of the template (of 16) that are prepared per frame afterwards, in [1, 16].
  //! Every so many images, while tracking, a piece of work goes into learning the template anew from cells that fit well,
  //! in [0, 1000000]; 0: never. About 115 pieces make a template, each takes about as long as tracking a small image once
  //! more. When the pattern turns or the template fits badly, the work of each image is that of learning.
  int refreshEvery = 128;
  double maxCellSigma = 0.25; //!< A cell with a larger standard deviation is not valid, px, in (0, 10].
  int maxLostFrames = 20;     //!< After more frames without a lock the identities start anew, in [0, 1000000].

  //! \throw vpException (badValue) that names the first field that is out of range, and its value.
  void check() const;
};

//! \ingroup group_pattern
//! \brief The method as a word ("GaussNewton"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpPatternMethod method);
//! \ingroup group_pattern
//! \brief The derivative as a word ("Symmetric"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpPatternDerivative derivative);

END_VISP_NAMESPACE
#endif
