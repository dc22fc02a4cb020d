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
//! samples.csv: a row for every period of the loop.
[[nodiscard]] std::string samplesCsv(const vpAvoidanceRun &run);
//! tracks.csv: the track table of every period, a row for each obstacle.
[[nodiscard]] std::string tracksCsv(const Diary &diary);
//! frames.csv: a row for every obstacle in every picture.
[[nodiscard]] std::string framesCsv(const Diary &diary);
} // namespace avoidObstacle

#endif
