/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file armTable.h
 * \brief Joint statistics of the arm, for the report.
 */
#ifndef servoCompare_armTable_h
#define servoCompare_armTable_h

#include "results.h"

#include "htmlReport.h"

namespace servoCompare
{
//! Limit margins, speeds, self-motion and status of each law on each plant, with the main measure, first seed.
[[nodiscard]] vpApp::HtmlTable armTable(const Plan &plan, const Results &results);

//! Root mean square of the joint errors of a law on each plant; with table 8.1 of the thesis if the arm is AMOR.
[[nodiscard]] vpApp::HtmlTable jointErrorTable(const Plan &plan, const Results &results, const std::string &law);
} // namespace servoCompare

#endif
