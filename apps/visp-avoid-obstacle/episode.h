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

#include "photoScene.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"
#include <visp3/avoidance/vpObjectTracks.h>

#include <array>
#include <string>
#include <vector>

namespace avoidObstacle
{
//! \brief One obstacle in one frame.
struct Sight {
  std::string object;                     //!< Name in the scene.
  bool seen = false;                      //!< It was detected.
  std::string message;                    //!< Result of the detection, or why it failed.
  double error = 0.;                      //!< Position error, m.
  double angleError = 0.;                 //!< Rotation error, rad.
  double sigma = 0.;                      //!< Reported standard deviation of the position, m.
  bool outlined = false;                  //!< #corners are valid.
  std::array<Eigen::Vector2d, 4> corners; //!< Corners in the image, px.
};

//! \brief One exposure.
struct Frame {
  double time = 0.; //!< s.
  bool covered = false;
  std::vector<Sight> sights; //!< One for each obstacle present.
  std::string jpeg;          //!< The grey image.
};

//! \brief One row of the track table at one time.
struct TrackRow {
  double time = 0.; //!< s.
  vpObjectTrack track;
  double error = 0.; //!< Position error, m; NaN when there is no such obstacle.
};

//! \brief Data of a run that vpAvoidanceRun does not hold.
struct SensorLog {
  std::vector<Frame> frames;
  std::vector<TrackRow> tracks;
};

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
