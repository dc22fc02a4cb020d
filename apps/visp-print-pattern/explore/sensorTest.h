/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file sensorTest.h
 * \brief How well a camera sees the cells: rendered pictures through vpPatternTracker, against the truth.
 */
#ifndef printExplore_sensorTest_h
#define printExplore_sensorTest_h

#include "lab/printing/vpPrintExperiment.h"

namespace printExplore
{
VISP_DIRECT_USING_NAMESPACE

//! \brief Errors of a sensor, px.
struct SensorTest {
  vpPrintSensorModel model; //!< Deviations of a cell, and how many cells are independent; for the estimators.
  double held = 0.;         //!< Share of the frames in which the tracker had cells, 0..1.
  double cells = 0.;        //!< Measured cells per frame.
  //! True if the tracker has hardly ever lost the product, and measured enough to tell its errors.
  [[nodiscard]] bool good() const { return held >= 0.95 && cells >= 1.; }
};

/*!
 * The tracker learns the product at a slow motion, as in the print experiment, and then sees it at the velocity of the drops.
 * \param product : What the camera sees. \param velocity : px/frame.
 */
[[nodiscard]] SensorTest testSensor(const vpProductPatternSpec &product, double velocity);
} // namespace printExplore

#endif
