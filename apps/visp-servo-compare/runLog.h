/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file runLog.h
 * \brief The runs for other programs: the log of each as CSV, the metrics of all as JSON.
 */
#ifndef servoCompare_runLog_h
#define servoCompare_runLog_h

#include "replay.h"
#include "results.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace servoCompare
{
//! File name of a run's log inside the result folder: "log/pbvs1-D-points-seed1.csv", shaped
//! "log/pbvs1-D-points-seed1-shaped.csv".
[[nodiscard]] std::string logName(const vpServoRunSpec &spec);
/*!
 * The log as CSV: a line of names with units, then a line for each cycle of the inner loop. Pose: camera in the world
 * (initial camera frame), translation and theta u. Twists: camera frame. All in m, rad, s and px.
 */
[[nodiscard]] std::string csvOf(const vpServoRun &run);
//! \brief What summary.json says besides plan and results.
struct Making {
  std::string commandLine;
  double wallTime; //!< s
  std::vector<ReplayVideo> videos;
  FilmStrip strip;
};
//! The content of summary.json, which schema.json of python/visp_direct/report describes.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Plan &plan, const Results &results, const Making &making);
} // namespace servoCompare

#endif
