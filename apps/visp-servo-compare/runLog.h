/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file runLog.h
 * \brief The log of a run as CSV.
 */
#ifndef servoCompare_runLog_h
#define servoCompare_runLog_h

#include "lab/servo/vpServoExperiment.h"

#include <string>

VISP_DIRECT_USING_NAMESPACE

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
} // namespace servoCompare

#endif
