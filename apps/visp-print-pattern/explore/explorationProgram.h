/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file explorationProgram.h
 * \brief Implementation of visp-print-pattern --explore: from a file to a result folder, on one process or many.
 */
#ifndef printExplore_explorationProgram_h
#define printExplore_explorationProgram_h

#include "ranks.h"

#include <string>

namespace printExplore
{
/*!
 * Explore and write explore.csv, front.csv, front.json, setup.json, summary.json and the report; rank 0 reads and writes.
 * \param file : Exploration file. \param out : Result folder. \param jobs : Threads of each rank; 0: its share of the
 * cores.
 * \param commandLine : For report and summary.
 * \throw std::runtime_error naming file, field and value.
 */
void exploreFile(const std::string &file, const std::string &out, unsigned int jobs, const std::string &commandLine,
                 const vpApp::Ranks &ranks);
} // namespace printExplore

#endif
