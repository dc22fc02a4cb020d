/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPatternTrackerSpec.h
 * \brief Parameters of vpPatternTracker; all are optional.
 */
#ifndef vpPatternOptions_h
#define vpPatternOptions_h

#include <visp3/pattern/vpPatternThreshold.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_pattern
//! \brief How the centre of a cell is measured.
enum class vpPatternMethod {
  GaussNewton,         //!< Learned template, aligned with the image; the others are baselines for comparison.
  HalfMaximumEdges,    //!< Threshold crossings of the grey value on all four sides.
  ThesisAlgorithm,     //!< Algorithm 7.4 as printed: biased by +0.5 px in x, and x no finer than the bounding box.
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
  Automatic, //!< The class that forms a lattice of equal spots; bright is tried first.
  Bright,    //!< Bright cells on a dark background.
  Dark       //!< Dark cells on a bright background.
};

/*!
 * \ingroup group_pattern
 * \brief Parameters of vpPatternTracker. The defaults suit every pattern with two visible periods in both directions.
 */
struct VISP_EXPORT vpPatternTrackerSpec {
  vpPatternMethod method = vpPatternMethod::GaussNewton;           //!< Method that measures a centre.
  vpPatternThreshold threshold = vpPatternThreshold::Otsu;         //!< Threshold for the acquisition and the baselines.
  vpPatternDerivative derivative = vpPatternDerivative::Symmetric; //!< Derivative for both variants of Algorithm 7.4.
  vpPatternPolarity polarity = vpPatternPolarity::Automatic;       //!< Which grey class is the cell.
  double minContrast = 12.; //!< Minimum difference of the two grey classes, grey values, in [1, 255].
  double minPitch = 6.;     //!< Minimum distance of neighbouring cells, px, in [4, 1000]; determines the memory.
  int learningFrames = 16;  //!< Frames from which the template is learned, in three passes, in [2, 10000].
  int phasesPerFrame = 2;   //!< Sub-pixel phases of the template (of 16) then prepared per frame, in [1, 16].
  //! Period, in images while tracking, of one unit of work for relearning the template from cells that fit well, in [0,
  //! 1000000]; 0: never. About 115 units make a template, each takes about as long as tracking a small image. When the
  //! pattern turns or the template fits badly, the work per image is that of learning.
  int refreshEvery = 128;
  double maxCellSigma = 0.25; //!< Maximum standard deviation of a valid cell, px, in (0, 10].
  int maxLostFrames = 20;     //!< Frames without a lock after which the identities restart, in [0, 1000000].
  /*!
   * Threads that share the cells of an image, the caller's included, in [1, 64]; for images with 128 cells and more while
   * tracking. Results are the same for any number, to the last bit. The others are started by the constructor, with the
   * scheduling policy, priority and processors of its thread. They sleep between images, and keep their processors busy during one.
   * process() takes no lock; it waits only for parts (64 cells) that another thread has begun, and does what none has.
   * FreeBSD and Linux; elsewhere one thread does everything.
   */
  int threads = 1;

  //! \throw vpException (badValue) that names the first field that is out of range, and its value.
  void check() const;
};

//! \ingroup group_pattern
//! \brief The method as a word ("GaussNewton"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpPatternMethod method);
//! \ingroup group_pattern
//! \brief The derivative as a word ("Symmetric"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpPatternDerivative derivative);

END_VISP_NAMESPACE
#endif
