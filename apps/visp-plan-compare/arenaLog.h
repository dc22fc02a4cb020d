/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file arenaLog.h
 * \brief Logs for Planner Arena: the text format of ompl::tools::Benchmark, which ompl_benchmark_statistics.py reads.
 */
#ifndef planCompare_arenaLog_h
#define planCompare_arenaLog_h

#include "results.h"

namespace planCompare
{
/*!
 * The log of one scene: each method is a planner, each problem a run. Times are planning times (start and all looks),
 * in s as in OMPL; everything else is in the units of vpAvoidanceMetrics.
 * \param startedAt : Start time in the form "2024-05-17 08:30:00".
 */
[[nodiscard]] std::string arenaLog(const Plan &plan, const Results &results, const SceneInfo &scene,
                                   const std::string &startedAt);
//! Current time in the format of arenaLog().
[[nodiscard]] std::string timeText();
} // namespace planCompare

#endif
