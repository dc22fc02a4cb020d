/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file sequence.h
 * \brief Renders a sequence into a result folder.
 */
#ifndef generatePattern_sequence_h
#define generatePattern_sequence_h

#include "options.h"
#include "outputFolder.h"

#include <cstddef>

namespace generatePattern
{
/*!
 * Write frames/, truth.csv, motion.csv and, if requested, video.mp4.
 * \return Number of lines of truth.csv without its heading.
 * \throw std::runtime_error naming a file that cannot be written; vpApp::Interrupted.
 */
[[nodiscard]] std::size_t writeSequence(const Options &options, vpApp::OutputFolder &out);
} // namespace generatePattern

#endif
