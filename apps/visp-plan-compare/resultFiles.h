/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file resultFiles.h
 * \brief The files for other programs: summary.json, the tables, and logs for Planner Arena.
 */
#ifndef planCompare_resultFiles_h
#define planCompare_resultFiles_h

#include "extras.h"
#include "results.h"

#include <nlohmann/json.hpp>

namespace planCompare
{
//! The content of summary.json without the fields added by OutputFolder.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Plan &plan, const Results &results, const Extras &extras);

//! runs.csv: one row per run.
[[nodiscard]] std::string runsCsv(const Results &results);
//! self-motion.csv: the distances of S5 over time.
[[nodiscard]] std::string selfMotionCsv(const std::vector<SelfMotionRow> &rows);
//! File name of a log: "log/S3-planner-dtg.csv".
[[nodiscard]] std::string logName(const std::string &scene, const std::string &method);
//! File name of the obstacles of the shown runs of a scene: "scene/S3.json".
[[nodiscard]] std::string sceneName(const std::string &scene);

/*!
 * A log for Planner Arena: the text format of ompl::tools::Benchmark, which ompl_benchmark_statistics.py reads. The log
 * of one scene: each method is a planner, each problem a run. Times are planning times (start and all looks),
 * in s as in OMPL; everything else is in the units of vpAvoidanceMetrics.
 * \param startedAt : Start time in the form "2024-05-17 08:30:00".
 */
[[nodiscard]] std::string arenaLog(const Plan &plan, const Results &results, const SceneInfo &scene,
                                   const std::string &startedAt);
//! Current time in the format of arenaLog().
[[nodiscard]] std::string timeText();
} // namespace planCompare

#endif
