/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file findings.h
 * \brief Sentences computed from the results, and the best method of a scene.
 */
#ifndef planCompare_findings_h
#define planCompare_findings_h

#include "extras.h"
#include "results.h"

namespace planCompare
{
//! The method that a scene is shown with: most successes, then the shortest median duration.
[[nodiscard]] std::string heroOf(const Plan &plan, const Results &results, const std::string &scene);
//! Main result in a few sentences.
[[nodiscard]] std::vector<std::string> answerOf(const Plan &plan, const Results &results);
//! Strengths and weaknesses of a method.
[[nodiscard]] std::string verdictOf(const Plan &plan, const Results &results, const std::string &method);
//! Results of a scene.
[[nodiscard]] std::vector<std::string> findingsOf(const Plan &plan, const Results &results, const SceneInfo &scene);
//! Result on the planners' validators; empty without them.
[[nodiscard]] std::string validatorFinding(const std::vector<ValidatorRow> &rows);
//! Result of S5; empty without it.
[[nodiscard]] std::string selfMotionFinding(const std::vector<SelfMotionRow> &rows);
} // namespace planCompare

#endif
