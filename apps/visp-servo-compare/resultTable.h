/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file resultTable.h
 * \brief Tables of laws by plants, with the best and the worst values marked.
 */
#ifndef servoCompare_resultTable_h
#define servoCompare_resultTable_h

#include "results.h"

#include "htmlReport.h"

namespace servoCompare
{
//! Image error, final error, yaw range and loss of view of each law on each plant, in groups of equal gain.
[[nodiscard]] vpApp::HtmlTable mainTable(const Plan &plan, const Results &results, const std::string &measure);
//! The other metrics: settling time, translation, path, peak speeds, deadlock, status.
[[nodiscard]] vpApp::HtmlTable furtherTable(const Plan &plan, const Results &results, const std::string &measure);
} // namespace servoCompare

#endif
