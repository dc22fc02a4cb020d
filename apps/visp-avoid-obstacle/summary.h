/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file summary.h
 * \brief The content of summary.json.
 */
#ifndef avoidObstacle_summary_h
#define avoidObstacle_summary_h

#include "replicas.h"
#include "story.h"

#include <nlohmann/json.hpp>

namespace avoidObstacle
{
//! The figures of a run by the names of vpAvoidanceMetrics.
[[nodiscard]] nlohmann::ordered_json metricsJson(const vpAvoidanceMetrics &metrics);
//! Everything about a run, but for what OutputFolder adds.
[[nodiscard]] nlohmann::ordered_json summaryOf(const PhotoScene &scene, const Options &options, const Episode &episode,
                                               const std::string &commandLine, double wallTime);
//! The same about a figure that was repeated.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Replica &replica, const Options &options,
                                               const std::string &commandLine, double wallTime);
} // namespace avoidObstacle

#endif
