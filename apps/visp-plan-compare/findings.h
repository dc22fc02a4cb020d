/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file findings.h
 * \brief What the numbers say, in sentences made of them.
 */
#ifndef planCompare_findings_h
#define planCompare_findings_h

#include "summary.h"

namespace planCompare
{
//! The answer in a few sentences.
[[nodiscard]] std::vector<std::string> answerOf(const Plan &plan, const Results &results);
//! What a method is good for, and what not.
[[nodiscard]] std::string verdictOf(const Plan &plan, const Results &results, const std::string &method);
//! What a scene shows.
[[nodiscard]] std::vector<std::string> findingsOf(const Plan &plan, const Results &results, const SceneInfo &scene);
//! Of the planners' validators; empty without them.
[[nodiscard]] std::string validatorFinding(const std::vector<ValidatorRow> &rows);
//! Of S5; empty without it.
[[nodiscard]] std::string selfMotionFinding(const std::vector<SelfMotionRow> &rows);
//! "17 of 20".
[[nodiscard]] std::string countText(int part, std::size_t all);
} // namespace planCompare

#endif
