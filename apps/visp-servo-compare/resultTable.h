/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file resultTable.h
 * \brief Laws against plants, with the best and the worst marked.
 */
#ifndef servoCompare_resultTable_h
#define servoCompare_resultTable_h

#include "results.h"

#include "htmlReport.h"

namespace servoCompare
{
//! Image error, end error, range of yaw and loss of view of each law on each plant, in groups of equal gain.
[[nodiscard]] vpApp::HtmlTable mainTable(const Plan &plan, const Results &results, const std::string &measure);
//! The other figures: settling time, translation, path, peak speeds, deadlock, status.
[[nodiscard]] vpApp::HtmlTable furtherTable(const Plan &plan, const Results &results, const std::string &measure);
} // namespace servoCompare

#endif
