/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file report.h
 * \brief Reports for users and programs: report.html, summary.json, and terminal output.
 */
#ifndef trackPattern_report_h
#define trackPattern_report_h

#include "options.h"
#include "results.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace trackPattern
{
//! Results in a few sentences.
[[nodiscard]] std::vector<std::string> findings(const RunResults &results);
//! report.html. \param video : The bytes of overlay.mp4, shown in the page; empty: none. \param commandLine : As typed.
[[nodiscard]] std::string reportPage(const RunResults &results, const Options &options, const std::string &video,
                                     const std::string &commandLine);
//! summary.json without the fields added by OutputFolder.
[[nodiscard]] nlohmann::ordered_json summaryOf(const RunResults &results, const Options &options,
                                               const std::string &commandLine);
} // namespace trackPattern

#endif
