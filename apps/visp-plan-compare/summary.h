/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file summary.h
 * \brief summary.json: all figures for other programs.
 */
#ifndef planCompare_summary_h
#define planCompare_summary_h

#include "results.h"
#include "selfMotion.h"
#include "validators.h"

#include <nlohmann/json.hpp>

namespace planCompare
{
//! \brief What was computed besides the runs.
struct Extras {
  std::vector<ValidatorRow> validators;
  std::vector<SelfMotionRow> selfMotion;
  std::string commandLine;
  double wallTime = 0.; //!< Of all, s.
};

//! The methods whose successes are compared pair by pair: (v) with (iii) when both were run; else none.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> pairsOf(const Plan &plan);
//! The content of summary.json, but for what OutputFolder adds.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Plan &plan, const Results &results, const Extras &extras);
} // namespace planCompare

#endif
