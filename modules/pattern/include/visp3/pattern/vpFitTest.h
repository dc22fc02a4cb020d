/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFitTest.h
 * \brief Whether a calibration's model fits its points, and which view and point fit worst.
 */
#ifndef vpFitTest_h
#define vpFitTest_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <limits>
#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_pattern
//! \brief What the residuals say of a fit.
enum class vpFitVerdict {
  NotTested, //!< There are no more numbers than parameters: nothing can be said.
  Fits,      //!< The residuals are noise, as far as the tests see.
  Misfit     //!< They are not: points are wrong, or the model is.
};

/*!
 * \ingroup group_pattern
 * \brief Tests of a least-squares fit by its residuals.
 *
 * Up to four tests share the probability #level of a false alarm evenly:
 * \li **whole**: the sum of squares against the points' stated deviations (chi-square), when these are stated;
 * \li **views** and **points**: each is left out in turn, and what it misses the fit of the rest by is compared with the
 * rest's own residuals (Fisher's F, the smallest probability times the number of views or points);
 * \li **field**: for each view, whether the residuals hold a smooth field (a polynomial of second or third degree of the
 * place in the image) that the model lacks (F, likewise).
 *
 * The last three need no stated deviation. The probabilities are exact where the model is linear in what the noise
 * moves, and for normal noise.
 */
struct VISP_EXPORT vpFitTest {
  vpFitVerdict verdict = vpFitVerdict::NotTested; //!< What they say together.
  double level = 0.01;                            //!< Probability that a right fit is called a misfit.
  //! Of the sum of squares, when the fit is right; NaN: no deviation was stated, or the test cannot be made.
  double wholeProbability = std::numeric_limits<double>::quiet_NaN();
  double viewProbability = std::numeric_limits<double>::quiet_NaN();  //!< Of the worst view; NaN for one view.
  double pointProbability = std::numeric_limits<double>::quiet_NaN(); //!< Of the worst point.
  double fieldProbability = std::numeric_limits<double>::quiet_NaN(); //!< Of the worst field of a view.
  int worstView = -1;             //!< The view that fits the others worst; with one view 0. -1: unknown.
  double worstViewRms = 0.;       //!< Root mean square residual of its points, px.
  int worstPointView = -1;        //!< View of the point that fits the others worst; -1: unknown.
  int worstPoint = -1;            //!< That point.
  double worstPointDistance = 0.; //!< How far it is from where the others put it, px.

  //! Name what does not fit, in a sentence; of a fit that holds, how it was tested.
  [[nodiscard]] std::string message(double varianceFactor) const;
};

//! \ingroup group_pattern
//! \brief The verdict as a word ("Misfit"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpFitVerdict verdict);

END_VISP_NAMESPACE
#endif
