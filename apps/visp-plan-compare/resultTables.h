/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file resultTables.h
 * \brief The tables of the report that hold results of runs.
 */
#ifndef planCompare_resultTables_h
#define planCompare_resultTables_h

#include "htmlReport.h"
#include "results.h"

namespace planCompare
{
//! Methods by scenes: success, and the median duration of the successes.
[[nodiscard]] vpApp::HtmlTable mainTable(const Plan &plan, const Results &results);
//! What each method does and is good for.
[[nodiscard]] vpApp::HtmlTable verdictTable(const Plan &plan, const Results &results);
//! All figures of a scene.
[[nodiscard]] vpApp::HtmlTable sceneTable(const Plan &plan, const Results &results, const std::string &scene);
//! Successes of a scene by variant.
[[nodiscard]] vpApp::HtmlTable variantTable(const Plan &plan, const Results &results, const std::string &scene);
} // namespace planCompare

#endif
