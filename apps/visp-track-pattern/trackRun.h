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

#include "imageSource.h"
#include "options.h"
#include "results.h"

#include "outputFolder.h"

namespace trackPattern
{
/*!
 * Write cells.csv and motion.csv, row by row, the overlay and, if asked for, calibration.json and calibration.xml.
 *
 * After Ctrl-C, and when a camera fails or a calibration is not possible, what was seen is a result all the same:
 * RunResults::ending tells.
 * \param results : Filled as the run goes; still good for its frames after an exception.
 * \throw std::runtime_error naming the image, file or camera that does not allow it; vpApp::Interrupted before the first image.
 */
void trackAll(const Options &options, ImageSource &source, vpApp::OutputFolder &out, RunResults &results);
} // namespace trackPattern

#endif
