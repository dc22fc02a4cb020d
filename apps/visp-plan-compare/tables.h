/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file tables.h
 * \brief CSV files: all runs, and the log of one run.
 */
#ifndef planCompare_tables_h
#define planCompare_tables_h

#include "results.h"

namespace planCompare
{
//! runs.csv: one row per run.
[[nodiscard]] std::string runsCsv(const Results &results);
//! Log of a run: one row per period.
[[nodiscard]] std::string logCsv(const vpAvoidanceRun &run);
//! File name of a log: "log/S3-planner-dtg.csv".
[[nodiscard]] std::string logName(const std::string &scene, const std::string &method);
} // namespace planCompare

#endif
