/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file story.h
 * \brief What happened in a run, in numbers and in words.
 */
#ifndef avoidObstacle_story_h
#define avoidObstacle_story_h

#include "episode.h"

#include <optional>

namespace avoidObstacle
{
//! \brief How one obstacle was seen.
struct Acquaintance {
  std::string object;
  std::size_t frames = 0;          //!< In which it was there.
  std::size_t seen = 0;            //!< Of them.
  std::optional<double> firstSeen; //!< Exposure, s.
  std::optional<double> known;     //!< First time that the method knew of it, s.
  std::optional<double> lastSeen;  //!< Exposure, s.
  std::optional<double> lost;      //!< First exposure after #lastSeen, s; none: seen to the end.
  double gap = 0.;                 //!< Longest time between two exposures in which it was seen, s.
  double medianError = 0.;         //!< Of the seen place, m; NaN: never seen.
  double worstError = 0.;          //!< m.
  double medianSigma = 0.;         //!< That the sightings told, m; NaN: never seen.
  double worstTrackError = 0.;     //!< Of the place in the track table, m.
  double leastMargin = 0.;         //!< Least inflation less error of the track while there was one, m.
};

//! One for each obstacle, in the order of the scene.
[[nodiscard]] std::vector<Acquaintance> acquaintances(const PhotoScene &scene, const Episode &episode);

//! \brief A time when the status of the method changed.
struct Turn {
  double time = 0.; //!< s.
  vpAvoidanceStatus status = vpAvoidanceStatus::Moving;
  bool stopping = false;
};
//! All of them; changes that last less than 50 ms are left out.
[[nodiscard]] std::vector<Turn> turnsOf(const vpAvoidanceRun &run);

//! Largest speed and acceleration of the commanded joints, as parts of their limits.
struct JointUse {
  double velocity = 0.;
  double acceleration = 0.;
};
[[nodiscard]] JointUse jointUseOf(const vpAvoidanceRun &run);

//! The answer in a few sentences: arrived or not and why, clearance, what was seen.
[[nodiscard]] std::vector<std::string> storyOf(const PhotoScene &scene, const Options &options, const Episode &episode);
} // namespace avoidObstacle

#endif
