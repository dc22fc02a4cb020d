/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file report.h
 * \brief Finished parts as results.json, summary.json and report.html.
 */
#ifndef thesisReport_report_h
#define thesisReport_report_h

#include "run.h"

#include <nlohmann/json.hpp>

#include <map>

namespace thesisReport
{
//! A row per quantity: id, quantity, unit, thesis, ours, ratio, tolerance, verdict, note; null for missing values.
[[nodiscard]] nlohmann::ordered_json resultsJson(const std::vector<Played> &all);
//! Verdict of each item, number of each verdict, and computing time.
[[nodiscard]] nlohmann::ordered_json summaryJson(const std::vector<Played> &all, const Options &options,
                                                 const std::string &commandLine, double wallTime);
//! Number of items with each verdict.
[[nodiscard]] std::map<Verdict, int> countVerdicts(const std::vector<Played> &all);
//! The page, with embedded figures.
[[nodiscard]] std::string reportPage(const std::vector<Played> &all, const std::string &commandLine, double wallTime);
} // namespace thesisReport

#endif
