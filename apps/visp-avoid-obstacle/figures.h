/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file figures.h
 * \brief Plots and drawings of a run.
 */
#ifndef avoidObstacle_figures_h
#define avoidObstacle_figures_h

#include "episode.h"

namespace avoidObstacle
{
//! \brief A figure, ready for the page: a drawing, a photograph, or a piece of HTML.
struct Figure {
  std::string name;    //!< File name without suffix.
  std::string title;   //!< In a few words.
  std::string caption; //!< What to see.
  std::string svg;     //!< A drawing; or empty.
  std::string jpeg;    //!< A picture; or empty.
  std::string html;    //!< An animation; or empty.
};

//! The tool's way and the arm from two sides, with the true obstacles and what was believed of them in the end.
[[nodiscard]] Figure drawWay(const vpAvoidanceRun &run, const std::string &title,
                             const std::vector<vpCollisionObject> &believed = {});
//! The run as an animation.
[[nodiscard]] Figure animate(const vpAvoidanceRun &run, const std::string &title);
//! Speed and acceleration of the commanded tool, joint speeds, clearance, distance from the goal.
[[nodiscard]] Figure drawTimes(const vpAvoidanceRun &run);
//! Seen or not, errors and uncertainty, speed and confidence of every obstacle in the track table.
[[nodiscard]] Figure drawTracks(const PhotoScene &scene, const Episode &episode);
//! What the camera saw at some times, with what was found outlined.
[[nodiscard]] Figure drawViews(const Episode &episode);

//! Speed and acceleration of a point that is at these places, a period apart, from rest; m/s, m/s^2.
struct Rates {
  std::vector<double> speed, acceleration;
};
[[nodiscard]] Rates ratesOf(const std::vector<Eigen::Vector3d> &places, double period);
//! Places of the tool at the commanded configurations, m.
[[nodiscard]] std::vector<Eigen::Vector3d> commandedWay(const vpAvoidanceRun &run);
} // namespace avoidObstacle

#endif
