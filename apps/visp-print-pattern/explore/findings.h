/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file findings.h
 * \brief Results of an exploration in sentences.
 */
#ifndef printExplore_findings_h
#define printExplore_findings_h

#include "exploration.h"

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
//! "95 % of the drops within 0.31 um, worst 0.40 um, 163.6 cells/s, 2.7 % of a core".
[[nodiscard]] std::string figuresText(const Outcome &outcome);
} // namespace printExplore

#endif
