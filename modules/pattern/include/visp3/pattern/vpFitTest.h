/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFitTest.h
 * \brief Tests whether a calibration's model fits its points, and which view and point fit worst.
 */
#ifndef vpFitTest_h
#define vpFitTest_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <limits>
#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_pattern
//! \brief Verdict on a fit from its residuals.
enum class vpFitVerdict {
  NotTested, //!< No more measurements than parameters: no test possible.
  Fits,      //!< The residuals are consistent with noise.
  Misfit     //!< The residuals are not noise: some points, or the model, are wrong.
};

/*!
 * \ingroup group_pattern
 * \brief Tests of a least-squares fit by its residuals.
 *
 * Up to four tests share the false-alarm probability #level evenly:
 * \li **whole**: the sum of squares against the points' given standard deviations (chi-square), when these are given;
 * \li **views** and **points**: each is left out in turn, and its misfit to the fit of the rest is compared with the
 * rest's own residuals (Fisher's F, the smallest probability times the number of views or points);
 * \li **field**: for each view, whether the residuals contain a smooth field (a polynomial of second or third degree in
 * the image position) that the model lacks (F, as above).
 *
 * The last three need no given deviation. The probabilities are exact for models that are linear over the noise range,
 * and for normal noise.
 */
struct VISP_EXPORT vpFitTest {
  vpFitVerdict verdict = vpFitVerdict::NotTested; //!< Verdict of all tests.
  double level = 0.01;                            //!< Probability that a correct fit is reported as a misfit.
  //! Probability of the sum of squares, for a correct fit; NaN: no deviation was given, or the test cannot be made.
  double wholeProbability = std::numeric_limits<double>::quiet_NaN();
  //! Probability of the worst view; NaN for one view.
  double viewProbability = std::numeric_limits<double>::quiet_NaN();
  double pointProbability = std::numeric_limits<double>::quiet_NaN(); //!< Probability of the worst point.
  double fieldProbability = std::numeric_limits<double>::quiet_NaN(); //!< Probability of the worst field of a view.
  int worstView = -1;             //!< View that fits the others worst; 0 for one view. -1: unknown.
  double worstViewRms = 0.;       //!< Root mean square residual of the points of #worstView, px.
  int worstPointView = -1;        //!< View of the point that fits the others worst; -1: unknown.
  int worstPoint = -1;            //!< Index of the point in #worstPointView that fits worst.
  double worstPointDistance = 0.; //!< Distance of that point from its prediction by the others, px.

  //! A sentence naming what does not fit, or the tests that were passed.
  [[nodiscard]] std::string message(double varianceFactor) const;
};

//! \ingroup group_pattern
//! \brief Verdict as a word ("Misfit"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpFitVerdict verdict);

END_VISP_NAMESPACE
#endif
