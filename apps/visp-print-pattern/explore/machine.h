/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file machine.h
 * \brief Timing of a design's camera, and its print experiment: the same machine and product, seen by its camera.
 */
#ifndef printExplore_machine_h
#define printExplore_machine_h

#include "design.h"

namespace printExplore
{
/*!
 * \brief Quantities of a design that depend only on camera and processor. Times in us.
 *
 * The trade-off (7.2) between image size and frame rate: an image takes readout = pixels / pixel rate; exposure and
 * readout (the longer of them if they overlap) must fit into a frame, like the computing, and pixels x frame rate into
 * the link. The delay from mid-exposure to the command is exposure / 2 + readout + interface + computing. Computing
 * takes frame + cells (cell + cellPixel x px of a pitch) + control, with the average number of whole cells in view.
 */
struct Timing {
  double period = 0.;      //!< Frame period.
  double readout = 0.;     //!< Readout time of an image.
  double computing = 0.;   //!< Computing time of an image and a control step.
  double delay = 0.;       //!< From mid-exposure to the control step.
  double delayFrames = 0.; //!< #delay in frames.
  double load = 0.;        //!< Computing load, fraction of a core.
  double dataRate = 0.;    //!< 1e6 bytes/s.
  double cells = 0.;       //!< Whole cells in view, on average.
  int leastCells = 0;      //!< Whole cells in view at the worst instant.
  double tracking = 0.;    //!< n_f M of (7.1): frames in which the product moves by a cell's length, at dropVelocity.
  double light = 1.;       //!< Photons per pixel relative to the camera's reference, after dimming the lamp.
};

//! The timing of a design.
[[nodiscard]] Timing timingOf(const Design &design, const Setup &setup);

//! Reason why a design cannot work, or none.
struct Verdict {
  std::string kind; //!< "camera", "link", "processor", "view", "delay", "tracker", "cells", "model"; empty: it works.
  std::string sentence; //!< Human-readable reason.
  [[nodiscard]] bool feasible() const { return kind.empty(); }
};

//! Checks a design before the simulation.
[[nodiscard]] Verdict checkTiming(const Design &design, const Setup &setup, const Timing &timing);

//! \brief Lengths of the product of thesis chapter 7, um.
struct Lengths {
  static constexpr double pitchX = 220., pitchY = 80., openingX = 178., openingY = 52.;
};

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
