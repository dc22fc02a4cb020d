/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief Finished parts as data; python/visp_direct/report/schema.json describes each field.
 */
#ifndef thesisReport_results_h
#define thesisReport_results_h

#include "run.h"

#include <nlohmann/json.hpp>

#include <map>

namespace thesisReport
{
//! results.json, a row per quantity; null for missing values.
[[nodiscard]] nlohmann::ordered_json resultsJson(const std::vector<Played> &all);
//! items.json: titles, remarks, parameters and figures; the curves are in curvesCsv().
[[nodiscard]] nlohmann::ordered_json itemsJson(const std::vector<Played> &all);
//! curves.csv: item, figure, panel, curve (from 0), x, y; an empty cell interrupts a line.
[[nodiscard]] std::string curvesCsv(const std::vector<Played> &all);
//! File of a picture: "figure/fig7.11-detection.png".
[[nodiscard]] std::string pictureFile(const Item &item, const Figure &figure);
//! Verdict of each item, number of each verdict, and computing time.
[[nodiscard]] nlohmann::ordered_json summaryJson(const std::vector<Played> &all, const Options &options,
                                                 const std::string &commandLine, double wallTime);
//! Number of rows with each verdict.
[[nodiscard]] std::map<Verdict, int> countRows(const std::vector<Played> &all);
} // namespace thesisReport

#endif
