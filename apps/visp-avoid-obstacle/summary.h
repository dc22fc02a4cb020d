/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file summary.h
 * \brief Content of summary.json.
 */
#ifndef avoidObstacle_summary_h
#define avoidObstacle_summary_h

#include "replicas.h"
#include "findings.h"

#include <nlohmann/json.hpp>

namespace avoidObstacle
{
//! Metrics of a run by the names of vpAvoidanceMetrics.
[[nodiscard]] nlohmann::ordered_json metricsJson(const vpAvoidanceMetrics &metrics);
//! Summary of a run, without the fields added by OutputFolder.
[[nodiscard]] nlohmann::ordered_json summaryOf(const PhotoScene &scene, const Options &options, const Episode &episode,
                                               const std::string &commandLine, double wallTime);
//! Summary of a reproduced figure, without the fields added by OutputFolder.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Replica &replica, const Options &options,
                                               const std::string &commandLine, double wallTime);
} // namespace avoidObstacle

#endif
