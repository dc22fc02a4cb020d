/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file findings.h
 * \brief The results in sentences, and the tables and summary.json that the report is made of.
 */
#ifndef trackPattern_findings_h
#define trackPattern_findings_h

#include "options.h"
#include "results.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace trackPattern
{
//! Results in a few sentences.
[[nodiscard]] std::vector<std::string> findings(const RunResults &results);
//! deviations.csv: deviations of all cells from the regular lattice, px, as last seen.
[[nodiscard]] std::string deviationsCsv(const RunResults &results);
//! summary.json without the fields added by OutputFolder.
[[nodiscard]] nlohmann::ordered_json summaryOf(const RunResults &results, const Options &options,
                                               const std::string &commandLine);
} // namespace trackPattern

#endif
