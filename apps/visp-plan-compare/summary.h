/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file summary.h
 * \brief summary.json: all results for other programs.
 */
#ifndef planCompare_summary_h
#define planCompare_summary_h

#include "results.h"
#include "selfMotion.h"
#include "validators.h"

#include <nlohmann/json.hpp>

namespace planCompare
{
//! \brief Results computed besides the runs.
struct Extras {
  std::vector<ValidatorRow> validators;
  std::vector<SelfMotionRow> selfMotion;
  std::string commandLine;
  double wallTime = 0.; //!< Total wall time, s.
};

//! Pairs of methods whose successes are compared: (v) with (iii) if both were run; else none.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> pairsOf(const Plan &plan);
//! The content of summary.json without the fields added by OutputFolder.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Plan &plan, const Results &results, const Extras &extras);
} // namespace planCompare

#endif
