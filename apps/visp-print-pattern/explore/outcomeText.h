/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outcomeText.h
 * \brief Outcomes as text: for exchange between ranks, and as files.
 */
#ifndef printExplore_outcomeText_h
#define printExplore_outcomeText_h

#include "exploration.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace printExplore
{
//! explore.csv: all designs; front.csv: those of the front.
[[nodiscard]] std::string exploreCsv(const Exploration &result, bool frontOnly);
//! summary.json without the fields that OutputFolder adds.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Setup &setup, const Exploration &result,
                                               const std::string &commandLine, double wallTime);
//! A design with all its metrics, by the column names of the CSV.
[[nodiscard]] nlohmann::ordered_json jsonOf(const Outcome &outcome);
} // namespace printExplore

#endif
