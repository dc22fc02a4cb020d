/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief Course of a run in words and numbers: findings, the content of summary.json, CSV files.
 */
#ifndef avoidObstacle_results_h
#define avoidObstacle_results_h

#include "episode.h"
#include "replicas.h"

#include "runData.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace avoidObstacle
{
//! \brief Detection statistics of one obstacle.
struct SightingSummary {
  std::string object;
  std::size_t frames = 0;          //!< Frames in which it was present.
  std::size_t seen = 0;            //!< Frames in which it was detected.
  std::optional<double> firstSeen; //!< Exposure of the first detection, s.
  std::optional<double> known;     //!< First time at which the method knew it, s.
  std::optional<double> lastSeen;  //!< Exposure of the last detection, s.
  std::optional<double> lost;      //!< First exposure after #lastSeen, s; none: seen to the end.
  double gap = 0.;                 //!< Longest time between two detections, s.
  double medianError = 0.;         //!< Median error of the detected position, m; NaN: never seen.
  double worstError = 0.;          //!< Largest error of the detected position, m.
  double medianSigma = 0.;         //!< Median reported sigma, m; NaN: never seen.
  double worstTrackError = 0.;     //!< Largest position error in the track table, m.
  double leastMargin = 0.;         //!< Smallest difference inflation - track error, while tracked, m.
};

//! Statistics of each obstacle, in scene order.
[[nodiscard]] std::vector<SightingSummary> sightingSummaries(const PhotoScene &scene, const Episode &episode);

//! \brief A status change of the method.
struct StatusChange {
  double time = 0.; //!< s.
  vpAvoidanceStatus status = vpAvoidanceStatus::Moving;
  bool stopping = false;
};
//! All status changes; those shorter than 50 ms are omitted.
[[nodiscard]] std::vector<StatusChange> statusChangesOf(const vpAvoidanceRun &run);

//! Largest speed and acceleration of the commanded joints, relative to their limits.
struct JointUse {
  double velocity = 0.;
  double acceleration = 0.;
};
[[nodiscard]] JointUse jointUseOf(const vpAvoidanceRun &run);

//! Result in a few sentences: arrived or not and why, clearance, detections.
[[nodiscard]] std::vector<std::string> findingsOf(const PhotoScene &scene, const Options &options,
                                                  const Episode &episode);

//! Summary of a run, without the fields added by OutputFolder, its video and its wall time.
[[nodiscard]] nlohmann::ordered_json summaryOf(const PhotoScene &scene, const Options &options, const Episode &episode,
                                               const std::string &commandLine);
//! Summary of a reproduced figure, without the fields added by OutputFolder.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Replica &replica, const Options &options,
                                               const std::string &commandLine, double wallTime);

//! tracks.csv: the track table of every period, one row per obstacle.
[[nodiscard]] std::string tracksCsv(const SensorLog &sensorLog);
//! frames.csv: one row per obstacle and image.
[[nodiscard]] std::string framesCsv(const SensorLog &sensorLog);
} // namespace avoidObstacle

#endif
