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
 * Write cells.csv, motion.csv, the overlay and, if asked for, calibration.json and calibration.xml.
 * \throw std::runtime_error naming the image, file or camera that does not allow it; vpApp::Interrupted.
 */
[[nodiscard]] RunResults trackAll(const Options &options, ImageSource &source, vpApp::OutputFolder &out);
} // namespace trackPattern

#endif
