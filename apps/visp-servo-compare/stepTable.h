/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file stepTable.h
 * \brief Comparison of raw and shaped runs: benefit and cost of the shaper.
 */
#ifndef servoCompare_stepTable_h
#define servoCompare_stepTable_h

#include "results.h"

#include "htmlReport.h"

namespace servoCompare
{
//! Raw and shaped metrics of each law side by side, medians over the seeds; no rows if nothing was run.
[[nodiscard]] vpApp::HtmlTable stepTable(const Plan &plan, const Results &results, const vpServoPlant &plant,
                                         const std::string &measure);
//! Benefit and cost of shaping, in sentences computed from the numbers. \param plan : With Plan::shaped.
[[nodiscard]] std::vector<std::string> stepFindings(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
