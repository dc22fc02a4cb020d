/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file findings.h
 * \brief Results of an exploration: in sentences, as tables and as JSON.
 */
#ifndef printExplore_findings_h
#define printExplore_findings_h

#include "exploration.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace printExplore
{
//! Number of infeasible designs, by the kind of their verdict.
[[nodiscard]] std::map<std::string, std::size_t> reasonsOf(const Exploration &result);
//! Description of a kind of verdict.
[[nodiscard]] std::string meaningOf(const std::string &kind);
//! Main result: number of feasible designs, best compromise, position of the thesis's camera.
[[nodiscard]] std::vector<std::string> findingsOf(const Setup &setup, const Exploration &result);

//! explore.csv: all designs; front.csv: those of the front.
[[nodiscard]] std::string exploreCsv(const Exploration &result, bool frontOnly);
//! summary.json without the fields that OutputFolder adds.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Setup &setup, const Exploration &result,
                                               const std::string &commandLine, double wallTime);
//! A design with all its metrics, by the column names of the CSV.
[[nodiscard]] nlohmann::ordered_json jsonOf(const Outcome &outcome);
} // namespace printExplore

#endif
