/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file machine.h
 * \brief The print experiment of a design: one machine and product, seen by its camera.
 */
#ifndef printExplore_machine_h
#define printExplore_machine_h

#include "cameraTiming.h"

namespace printExplore
{
/*!
 * The stage of vpXYStageSpec::thesis(), the product and print head of thesis chapter 7 and the reference in um and seconds, in
 * the units of the design's camera (vpInUnits()); what the camera sees by its light, exposure and blur.
 *
 * Gains of the observer's control stay as they are in seconds: it knows the delay, what bounds it is the lag of the drives.
 * Those of the PIDs, the poles of their filter and its prediction are slowed down as the loop's delay (camera, half a frame, lag) is longer than
 * that of the thesis's, and the other way round: kp x delay is always the thesis's.
 * \param sensor : Errors that the estimators expect, px of this camera.
 * \throw vpException naming a field that the experiment does not allow.
 */
[[nodiscard]] vpPrintExperimentSpec experimentOf(const Design &design, const Setup &setup, const Timing &timing,
                                                 const vpPrintSensorModel &sensor);
//! What the camera sees of the product, px of the camera.
[[nodiscard]] vpProductPatternSpec productOf(const Design &design, const Setup &setup, const Timing &timing);
} // namespace printExplore

#endif
