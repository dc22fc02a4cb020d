/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file resultTables.h
 * \brief Result tables of the report.
 */
#ifndef planCompare_resultTables_h
#define planCompare_resultTables_h

#include "htmlReport.h"
#include "results.h"

namespace planCompare
{
//! Methods by scenes: successes, and their median duration.
[[nodiscard]] vpApp::HtmlTable mainTable(const Plan &plan, const Results &results);
//! Description and strengths of each method.
[[nodiscard]] vpApp::HtmlTable verdictTable(const Plan &plan, const Results &results);
//! All metrics of a scene.
[[nodiscard]] vpApp::HtmlTable sceneTable(const Plan &plan, const Results &results, const std::string &scene);
//! Successes of a scene by variant.
[[nodiscard]] vpApp::HtmlTable variantTable(const Plan &plan, const Results &results, const std::string &scene);
} // namespace planCompare

#endif
