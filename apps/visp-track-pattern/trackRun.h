/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file trackRun.h
 * \brief Tracks every image of a source and writes the tables and overlays.
 */
#ifndef trackPattern_trackRun_h
#define trackPattern_trackRun_h

#include "input.h"
#include "options.h"
#include "results.h"

#include "outputFolder.h"

namespace trackPattern
{
/*!
 * Write cells.csv and motion.csv, row by row, the overlay and, if requested, calibration.json and calibration.xml.
 *
 * After Ctrl-C, a camera failure or a failed calibration, the images so far still give a result, see
 * RunResults::ending.
 * \param results : Filled during the run; its frames remain valid after an exception.
 * \throw std::runtime_error naming the failing image, file or camera; vpApp::Interrupted before the first image.
 */
void trackAll(const Options &options, const Input &input, vpApp::OutputFolder &out, RunResults &results);
} // namespace trackPattern

#endif
