/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file identification.h
 * \brief Mass and friction of the stage from a ramp measured by the camera.
 */
#ifndef printPattern_identification_h
#define printPattern_identification_h

#include <visp3/printing/vpFrictionIdentification.h>
#include "lab/printing/vpPrintExperiment.h"

namespace printPattern
{
VISP_DIRECT_USING_NAMESPACE

//! \brief Identified and true parameters of the simulated stage.
struct Identification {
  vpFrictionIdentification found; //!< Identified from the camera's positions.
  vpFrictionModel truth;          //!< True model of the stage, near the start.
  int frames = 0;                 //!< Length of the ramp.
};

/*!
 * Drive the x axis in open loop with a slowly oscillating force of growing amplitude; measure the product's position in
 * each frame with the sensor error; smooth it, and identify.
 * \param spec : Stage, sensor model, seed.
 */
[[nodiscard]] Identification identifyStage(const vpPrintExperimentSpec &spec);
//! Use the identified model in observer, preview and feedforward. \throw std::runtime_error with the sentence of a
//! failure.
void useIdentified(const Identification &identification, vpPrintExperimentSpec &spec);
} // namespace printPattern

#endif
