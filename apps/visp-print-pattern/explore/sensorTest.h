/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file sensorTest.h
 * \brief Accuracy of a camera for the cells: rendered images through vpPatternTracker, against the ground truth.
 */
#ifndef printExplore_sensorTest_h
#define printExplore_sensorTest_h

#include "lab/printing/vpPrintExperiment.h"

namespace printExplore
{
VISP_DIRECT_USING_NAMESPACE

//! \brief Errors of a sensor, px.
struct SensorTest {
  vpPrintSensorModel model; //!< Standard deviations of a cell, and number of independent cells; for the estimators.
  double held = 0.;         //!< Fraction of frames in which the tracker had cells, 0..1.
  double cells = 0.;        //!< Measured cells per frame.
  //! True if the tracker hardly ever lost the product, and measured enough cells to estimate its errors.
  [[nodiscard]] bool good() const { return held >= 0.95 && cells >= 1.; }
};

/*!
 * The tracker learns the product at slow motion, as in the print experiment, then sees it at the drop velocity.
 * \param product : Product seen by the camera. \param velocity : px/frame.
 */
[[nodiscard]] SensorTest testSensor(const vpProductPatternSpec &product, double velocity);
} // namespace printExplore

#endif
