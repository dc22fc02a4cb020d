/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file episode.h
 * \brief One closed-loop run, from image to joints, with all its data.
 */
#ifndef avoidObstacle_episode_h
#define avoidObstacle_episode_h

#include "sensorLog.h"
#include "photoScene.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

namespace avoidObstacle
{
//! \brief A finished run and its sensorLog.
struct Episode {
  vpAvoidanceRun run;
  SensorLog sensorLog;
};

//! Specification of the run; the sensor and the track table write into \e sensorLog, which must outlive the run.
[[nodiscard]] vpAvoidanceRunSpec specOf(const PhotoScene &scene, const Options &options, SensorLog &sensorLog);
//! Runs the episode. \throw vpApp::Interrupted after Ctrl-C; vpException naming the invalid field.
[[nodiscard]] Episode play(const PhotoScene &scene, const Options &options);
//! The obstacles known to the method at a time, with their inflation; depth maps as a dot.
[[nodiscard]] std::vector<vpCollisionObject> believedAt(const Episode &episode, double time);
} // namespace avoidObstacle

#endif
