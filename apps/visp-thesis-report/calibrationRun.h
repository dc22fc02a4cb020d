/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file calibrationRun.h
 * \brief A distorted microscope, calibrated by single images of a pattern.
 */
#ifndef thesisReport_calibrationRun_h
#define thesisReport_calibrationRun_h

#include "part.h"
#include "patternRun.h"

#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <string>
#include <vector>

namespace thesisReport
{
//! \brief A pattern under the microscope, and what is true of it.
struct CalibrationPattern {
  std::string name;
  vpProductPatternSpec spec;      //!< As it looks without distortion, 640 x 480 px.
  vpCalibrationPitch pitch;       //!< m.
  double umPerPixel = 1.;         //!< True magnification.
  double kappa = 0.;              //!< True distortion, per um^2 of product.
  vpPatternMethod thesisMethod{}; //!< How the thesis would find its points.
};

//! Squares of 100 um every 200 um, dark on bright, with the magnification and kappa1 of the thesis's industrial grid.
[[nodiscard]] CalibrationPattern squareGrid(unsigned int seed);
//! Round dots instead of the squares.
[[nodiscard]] CalibrationPattern dotGrid(unsigned int seed);
//! The display, with the magnification and kappa1 that the thesis found with it.
[[nodiscard]] CalibrationPattern displayPattern(unsigned int seed);

//! The microscope that sees a pattern: its principal point is the middle of the image.
[[nodiscard]] vpMicroscopeCalibration truthOf(const CalibrationPattern &pattern);

//! \brief What the experiments gave, each from one image.
struct CalibrationOutcome {
  Spread kappa;        //!< um^-2.
  Spread umPerPixel;   //!< um.
  Spread error;        //!< Distance of each point from where the calibration expects it, um of product.
  double points = 0.;  //!< Of an image, mean.
  int significant = 0; //!< Experiments in which kappa1 can be told from zero.
  vpMicroscopeCalibration last;
};

/*!
 * Calibrate by \e experiments images of a pattern, each shifted by up to 100 px each way and each for itself.
 * \param methods : How the points are found; one outcome for each, all from the same images.
 */
[[nodiscard]] std::vector<CalibrationOutcome> calibrate(const CalibrationPattern &pattern,
                                                        const std::vector<vpPatternMethod> &methods, int experiments,
                                                        unsigned int seed);
} // namespace thesisReport

#endif
