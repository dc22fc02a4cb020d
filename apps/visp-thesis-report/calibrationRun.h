/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file calibrationRun.h
 * \brief A distorted microscope, calibrated from single images of a pattern.
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
//! \brief A pattern under the microscope, with ground truth.
struct CalibrationPattern {
  std::string name;
  vpProductPatternSpec spec;      //!< Pattern without distortion, 640 x 480 px.
  vpCalibrationPitch pitch;       //!< m.
  double umPerPixel = 1.;         //!< True magnification.
  double kappa = 0.;              //!< True distortion, per um^2 of product.
  vpPatternMethod thesisMethod{}; //!< Point detection of the thesis.
};

//! Squares of 100 um every 200 um, dark on bright, with the magnification and kappa1 of the thesis's industrial grid.
[[nodiscard]] CalibrationPattern squareGrid(unsigned int seed);
//! Round dots instead of the squares.
[[nodiscard]] CalibrationPattern dotGrid(unsigned int seed);
//! The display, with the magnification and kappa1 found by the thesis.
[[nodiscard]] CalibrationPattern displayPattern(unsigned int seed);

//! The microscope for a pattern: its principal point is the image centre.
[[nodiscard]] vpMicroscopeCalibration truthOf(const CalibrationPattern &pattern);

//! \brief Results of the experiments, each from one image.
struct CalibrationOutcome {
  Spread kappa;        //!< um^-2.
  Spread umPerPixel;   //!< um.
  Spread error;        //!< Distance of each point from its position by the calibration, um of product.
  double points = 0.;  //!< Mean number of points of an image.
  int significant = 0; //!< Experiments in which kappa1 differs significantly from zero.
  vpMicroscopeCalibration last;
};

/*!
 * Calibrate from \e experiments images of a pattern, each separately and shifted by up to 100 px in each direction.
 * \param methods : Point detection methods; one outcome for each, all from the same images.
 */
[[nodiscard]] std::vector<CalibrationOutcome> calibrate(const CalibrationPattern &pattern,
                                                        const std::vector<vpPatternMethod> &methods, int experiments,
                                                        unsigned int seed);
} // namespace thesisReport

#endif
