/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file stepTable.h
 * \brief Raw beside shaped runs: what the shaper takes away, and what it costs.
 */
#ifndef servoCompare_stepTable_h
#define servoCompare_stepTable_h

#include "results.h"

#include "htmlReport.h"

namespace servoCompare
{
//! Raw and shaped figures of each law side by side, medians over the seeds; without rows if nothing was run there.
[[nodiscard]] vpApp::HtmlTable stepTable(const Plan &plan, const Results &results, const vpServoPlant &plant,
                                         const std::string &measure);
//! What shaping took away and what it cost, in sentences that follow from the numbers. \param plan : With Plan::shaped.
[[nodiscard]] std::vector<std::string> stepFindings(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
