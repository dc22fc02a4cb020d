/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file tables.h
 * \brief Tables of the report: laws by plants with the best and the worst values marked, raw against shaped runs, joints.
 */
#ifndef servoCompare_tables_h
#define servoCompare_tables_h

#include "results.h"

#include "htmlReport.h"

namespace servoCompare
{
//! Image error, final error, yaw range and loss of view of each law on each plant, in groups of equal gain.
[[nodiscard]] vpApp::HtmlTable mainTable(const Plan &plan, const Results &results, const std::string &measure);
//! The other metrics: settling time, translation, path, peak speeds, deadlock, status.
[[nodiscard]] vpApp::HtmlTable furtherTable(const Plan &plan, const Results &results, const std::string &measure);

//! Raw and shaped metrics of each law side by side, medians over the seeds; no rows if nothing was run.
[[nodiscard]] vpApp::HtmlTable stepTable(const Plan &plan, const Results &results, const vpServoPlant &plant,
                                         const std::string &measure);
//! Benefit and cost of shaping, in sentences computed from the numbers. \param plan : With Plan::shaped.
[[nodiscard]] std::vector<std::string> stepFindings(const Plan &plan, const Results &results);

//! Limit margins, speeds, self-motion and status of each law on each plant, with the main measure, first seed.
[[nodiscard]] vpApp::HtmlTable armTable(const Plan &plan, const Results &results);

//! Root mean square of the joint errors of a law on each plant; with table 8.1 of the thesis if the arm is AMOR.
[[nodiscard]] vpApp::HtmlTable jointErrorTable(const Plan &plan, const Results &results, const std::string &law);
} // namespace servoCompare

#endif
