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

#include <functional>
#include <string>

namespace printExplore
{
/*!
 * Run the body of a program on every rank like vpApp::runMain(). A failure is reported by its rank in one
 * sentence and ends all ranks.
 * \return The exit status.
 */
[[nodiscard]] int runRanks(const std::string &program, const std::function<void(const Ranks &)> &body);

/*!
 * Read the command line on rank 0 first, so that errors and help are printed once.
 * \param read : Returns false when nothing is left to do.
 * \return The result of \e read, on all ranks.
 */
[[nodiscard]] bool readOnFirst(const Ranks &ranks, const std::function<bool()> &read);

/*!
 * Explore and write report.html, explore.csv, front.csv, front.json and summary.json; rank 0 reads and writes.
 * \param file : Exploration file. \param out : Result folder. \param jobs : Threads of each rank; 0: its share of the
 * cores.
 * \param commandLine : For report and summary.
 * \throw std::runtime_error naming file, field and value.
 */
void exploreFile(const std::string &file, const std::string &out, unsigned int jobs, const std::string &commandLine,
                 const Ranks &ranks);
} // namespace printExplore

#endif
