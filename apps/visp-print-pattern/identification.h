/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file identification.h
 * \brief Mass and friction of the stage from a ramp that the camera watches.
 */
#ifndef printPattern_identification_h
#define printPattern_identification_h

#include <visp3/printing/vpFrictionIdentification.h>
#include "lab/printing/vpPrintExperiment.h"

namespace printPattern
{
VISP_DIRECT_USING_NAMESPACE

//! \brief What the ramp showed, beside what the simulated stage was made of.
struct Identification {
  vpFrictionIdentification found; //!< From the camera's places.
  vpFrictionModel truth;          //!< Of the stage, near the start.
  int frames = 0;                 //!< Length of the ramp.
};

/*!
 * Drive the x axis with a force that swings slowly to and fro with growing strength, open loop; take the product's place in
 * each frame with the error of the sensor; smooth it, and identify.
 * \param spec : Stage, sensor model, seed.
 */
[[nodiscard]] Identification identifyStage(const vpPrintExperimentSpec &spec);
//! Let observer, preview and feedforward use what was found. \throw std::runtime_error with the sentence of a failure.
void useIdentified(const Identification &identification, vpPrintExperimentSpec &spec);
} // namespace printPattern

#endif
