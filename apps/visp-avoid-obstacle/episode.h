/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file episode.h
 * \brief One run of the closed loop, from image to joints, with all that is known of it.
 */
#ifndef avoidObstacle_episode_h
#define avoidObstacle_episode_h

#include "diary.h"
#include "photoScene.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

namespace avoidObstacle
{
//! \brief A finished run and its diary.
struct Episode {
  vpAvoidanceRun run;
  Diary diary;
};

//! What visp-avoid-obstacle runs; the sensor and the track table write into \e diary, which must outlive the run.
[[nodiscard]] vpAvoidanceRunSpec specOf(const PhotoScene &scene, const Options &options, Diary &diary);
//! Runs it. \throw vpApp::Interrupted after Ctrl-C; vpException naming what the spec gets wrong.
[[nodiscard]] Episode play(const PhotoScene &scene, const Options &options);
//! The obstacles as the method knew them at a time, with their inflation; maps of depths as a dot.
[[nodiscard]] std::vector<vpCollisionObject> believedAt(const Episode &episode, double time);
} // namespace avoidObstacle

#endif
