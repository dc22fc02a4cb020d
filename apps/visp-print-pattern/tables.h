/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file tables.h
 * \brief Runs as CSV and as summary.json.
 */
#ifndef printPattern_tables_h
#define printPattern_tables_h

#include "design.h"
#include "results.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace printPattern
{
//! True and estimated state of each frame; see data/pattern/README.md.
[[nodiscard]] std::string motionCsv(const vpPrintRun &run);
//! Landing position of each drop.
[[nodiscard]] std::string dropsCsv(const vpPrintRun &run);
//! Landing errors of all drops of all runs.
[[nodiscard]] std::string landingCsv(const Landing &landing);
//! Figure 7.10: displacement of a pixel by radial distortion.
[[nodiscard]] std::string distortionCsv();
//! Name of the file with the first run of an experiment of the thesis: "thesis/figure-7.13.csv".
[[nodiscard]] std::string fileOf(const Replica &replica, std::size_t number);
//! Results in a few sentences.
[[nodiscard]] std::vector<std::string> findings(const Results &results);
//! summary.json without the fields that OutputFolder adds.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Options &options, const Results &results,
                                               const std::string &commandLine, double wallTime);
//! Names on the command line.
using printExplore::nameOf;
[[nodiscard]] std::string nameOf(vpPrintReferenceMode mode);
} // namespace printPattern

#endif
