/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file summary.h
 * \brief The metrics of all runs as JSON.
 */
#ifndef servoCompare_summary_h
#define servoCompare_summary_h

#include "results.h"

#include <nlohmann/json.hpp>

namespace servoCompare
{
/*!
 * The content of summary.json. \param commandLine : Command line of the program. \param wallTime : s.
 */
[[nodiscard]] nlohmann::ordered_json summaryOf(const Plan &plan, const Results &results, const std::string &commandLine,
                                               double wallTime);
} // namespace servoCompare

#endif
