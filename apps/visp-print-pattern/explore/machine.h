/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file machine.h
 * \brief Print experiment of a design: the same machine and product, seen by its camera.
 */
#ifndef printExplore_machine_h
#define printExplore_machine_h

#include "cameraTiming.h"

namespace printExplore
{
/*!
 * The stage of vpXYStageSpec::thesis(), the product and print head of thesis chapter 7 and the reference in um and
 * seconds, converted to the units of the design's camera (vpInUnits()); the image follows from its light, exposure and
 * blur.
 *
 * Gains of the observer's control are constant in seconds: it knows the delay and is limited by the lag of the drives.
 * PID gains, the poles of their filter and its prediction are slowed down or sped up with the loop's delay (camera,
 * half a frame, lag) relative to the thesis: kp x delay is always that of the thesis.
 * \param sensor : Errors expected by the estimators, px of this camera.
 * \throw vpException naming a field that the experiment rejects.
 */
[[nodiscard]] vpPrintExperimentSpec experimentOf(const Design &design, const Setup &setup, const Timing &timing,
                                                 const vpPrintSensorModel &sensor);
//! The product as seen by the camera, in its px.
[[nodiscard]] vpProductPatternSpec productOf(const Design &design, const Setup &setup, const Timing &timing);
} // namespace printExplore

#endif
