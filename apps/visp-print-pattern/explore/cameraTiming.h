/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file cameraTiming.h
 * \brief What a camera can deliver, how late, and what computing costs.
 */
#ifndef printExplore_cameraTiming_h
#define printExplore_cameraTiming_h

#include "design.h"

namespace printExplore
{
/*!
 * \brief Numbers of a design that follow from camera and processor alone. Times in us.
 *
 * The trade-off (7.2) between image size and frame rate: an image takes readout = pixels / pixel rate; exposure and readout
 * (the longer of them if they overlap) must fit into a frame, as must the computing, and pixels x frame rate into the link.
 * From the middle of the exposure to the command passes exposure / 2 + readout + interface + computing. Computing costs
 * frame + cells (cell + cellPixel x px of a pitch) + control, with the whole cells that are in view on average.
 */
struct Timing {
  double period = 0.;      //!< Of a frame.
  double readout = 0.;     //!< Of an image.
  double computing = 0.;   //!< Of an image and a control step.
  double delay = 0.;       //!< From the middle of the exposure to the control step.
  double delayFrames = 0.; //!< The same in frames.
  double load = 0.;        //!< Computing: share of a core.
  double dataRate = 0.;    //!< 1e6 bytes/s.
  double cells = 0.;       //!< Whole cells in view, on average.
  int leastCells = 0;      //!< The same at the worst instant.
  double tracking = 0.;    //!< n_f M of (7.1): frames in which the product moves by a cell's length, at dropVelocity.
  double light = 1.;       //!< Photons per pixel over those of the camera's reference, after dimming the lamp.
};

//! The numbers of a design.
[[nodiscard]] Timing timingOf(const Design &design, const Setup &setup);

//! Why a design cannot work, or that it may.
struct Verdict {
  std::string kind; //!< "camera", "link", "processor", "view", "delay", "tracker", "cells", "model"; empty: it works.
  std::string sentence; //!< For a person.
  [[nodiscard]] bool feasible() const { return kind.empty(); }
};

//! What forbids the design before anything is simulated.
[[nodiscard]] Verdict checkTiming(const Design &design, const Setup &setup, const Timing &timing);

//! \brief Lengths of the product of thesis chapter 7, um.
struct Lengths {
  static constexpr double pitchX = 220., pitchY = 80., openingX = 178., openingY = 52.;
};
} // namespace printExplore

#endif
