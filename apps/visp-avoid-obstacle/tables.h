/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file tables.h
 * \brief A run as CSV files.
 */
#ifndef avoidObstacle_tables_h
#define avoidObstacle_tables_h

#include "episode.h"

namespace avoidObstacle
{
//! samples.csv: one row per period of the loop.
[[nodiscard]] std::string samplesCsv(const vpAvoidanceRun &run);
//! tracks.csv: the track table of every period, one row per obstacle.
[[nodiscard]] std::string tracksCsv(const SensorLog &sensorLog);
//! frames.csv: one row per obstacle and image.
[[nodiscard]] std::string framesCsv(const SensorLog &sensorLog);
} // namespace avoidObstacle

#endif
