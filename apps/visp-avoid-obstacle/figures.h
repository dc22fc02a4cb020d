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

#include "plot.h"

namespace avoidObstacle
{
//! \brief A figure for the page: a drawing, an image, or an HTML fragment.
struct Figure {
  std::string name;    //!< File name without suffix.
  std::string title;   //!< Short title.
  std::string caption; //!< Explanation.
  std::string svg;     //!< Drawing, or empty.
  std::string jpeg;    //!< Image, or empty.
  std::string html;    //!< Animation, or empty.
};

//! Tool path and arm from two sides, with the true obstacles and their final tracks.
[[nodiscard]] Figure drawWay(const vpAvoidanceRun &run, const std::string &title,
                             const std::vector<vpCollisionObject> &believed = {});
//! The run as an animation.
[[nodiscard]] Figure animate(const vpAvoidanceRun &run, const std::string &title);
//! Speed and acceleration of the commanded tool, joint speeds, clearance, distance from the goal.
[[nodiscard]] Figure drawTimes(const vpAvoidanceRun &run);
//! Visibility, errors and uncertainty, speed and confidence of every obstacle in the track table.
[[nodiscard]] Figure drawTracks(const PhotoScene &scene, const Episode &episode);
//! Camera images at some times, with detections outlined.
[[nodiscard]] Figure drawViews(const Episode &episode);

//! Speed and acceleration of a point at these positions, one period apart, from rest; m/s, m/s^2.
struct Rates {
  std::vector<double> speed, acceleration;
};
[[nodiscard]] Rates ratesOf(const std::vector<Eigen::Vector3d> &places, double period);
//! Tool positions at the commanded configurations, m.
[[nodiscard]] std::vector<Eigen::Vector3d> commandedWay(const vpAvoidanceRun &run);

// Motions in the plane, as in the figures of chapter 8.

//! Path as a curve. \param thin : Keep every thin-th point.
[[nodiscard]] vpApp::PlotCurve wayCurve(const std::string &label, const std::string &colour,
                                        const std::vector<Eigen::Vector2d> &way, std::size_t thin = 1);
//! Single positions as points.
[[nodiscard]] vpApp::PlotCurve placeCurve(const std::string &label, const std::string &colour,
                                          const std::vector<Eigen::Vector2d> &places);
//! Map: x to the right, y up, to scale.
[[nodiscard]] vpApp::Plot wayPlot(const std::string &title);
} // namespace avoidObstacle

#endif
