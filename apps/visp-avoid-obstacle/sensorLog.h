/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file sensorLog.h
 * \brief Sightings and tracks of a run, per frame and per period.
 */
#ifndef avoidObstacle_sensorLog_h
#define avoidObstacle_sensorLog_h

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
} // namespace avoidObstacle

#endif
