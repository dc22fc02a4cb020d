/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file diary.h
 * \brief What was seen and believed during a run, frame by frame and period by period.
 */
#ifndef avoidObstacle_diary_h
#define avoidObstacle_diary_h

#include <visp3/avoidance/vpObjectTracks.h>

#include <array>
#include <string>
#include <vector>

namespace avoidObstacle
{
//! \brief One obstacle in one frame.
struct Sight {
  std::string object;                     //!< Name in the scene.
  bool seen = false;                      //!< A sighting came of it.
  std::string sentence;                   //!< How it went, or why it was not seen.
  double error = 0.;                      //!< Of its place, m.
  double angleError = 0.;                 //!< Of its rotation, rad.
  double sigma = 0.;                      //!< Deviation of the place that the sighting tells, m.
  bool outlined = false;                  //!< #corners count.
  std::array<Eigen::Vector2d, 4> corners; //!< In the picture, px.
};

//! \brief One exposure.
struct Frame {
  double time = 0.; //!< s.
  bool covered = false;
  std::vector<Sight> sights; //!< Of the obstacles that are there.
  std::string jpeg;          //!< The picture, grey.
};

//! \brief One row of the track table at one time.
struct TrackRow {
  double time = 0.; //!< s.
  vpObjectTrack track;
  double error = 0.; //!< Of its place, m; not a number when there is no such obstacle.
};

//! \brief Everything of a run that vpAvoidanceRun does not hold.
struct Diary {
  std::vector<Frame> frames;
  std::vector<TrackRow> tracks;
};
} // namespace avoidObstacle

#endif
