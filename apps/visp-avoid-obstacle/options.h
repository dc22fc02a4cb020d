/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-avoid-obstacle.
 */
#ifndef avoidObstacle_options_h
#define avoidObstacle_options_h

#include "robotOptions.h"

#include <string>
#include <utility>
#include <vector>

namespace avoidObstacle
{
//! \brief Sensor of the obstacles.
enum class SensorKind {
  Image, //!< Photographs in images of the eye-in-hand camera.
  Depth, //!< Depth images of the eye-in-hand camera, as a map of cubes.
  Poses  //!< Noisy poses: a vision system that detects everything in range.
};

//! \brief User options, not yet resolved.
struct Options {
  std::string method; //!< Name; by default "dtg-via", of another arm than AMOR "planner-dtg".
  std::string scene;  //!< JSON file; empty for the default scene.
  vpApp::RobotOptions robot;
  std::string targets; //!< Folder with targets.json; empty for that of the data folder.
  SensorKind sensor = SensorKind::Image;
  std::vector<std::pair<double, double>> hidden; //!< Intervals with covered camera: from, until; s.
  double visionRate = 30.;                       //!< Hz.
  double latency = 0.05;                         //!< s.
  double duration = 20.;                         //!< Maximum duration, s.
  double forget = 0.;                            //!< Forget obstacles unseen for this time, s; 0: never.
  double noise = 2.;                             //!< Image noise, grey values.
  double friction = 1.;                          //!< Joint friction relative to the arm's file; 0: ideal drives.
  bool frictionGiven = false;                    //!< By the user; else an arm without masses has ideal drives.
  unsigned int seed = 1;
  std::string replica; //!< Name of a figure; empty for none.
  std::string out = "out/avoid-obstacle";
  bool record = false;  //!< Write a video.
  bool display = false; //!< Also show it in a window.
  bool list = false;
};

//! "image", "depth" or "poses".
[[nodiscard]] const char *nameOf(SensorKind kind);

/*!
 * Read the command line.
 * \return False when `--help` or `--version` was requested and printed.
 * \throw vpApp::UsageError naming the option and its value.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);

//! Exit status in addition to vpApp::ExitStatus: report written, and the moving arm hit something.
constexpr int ExitHit = 3;

} // namespace avoidObstacle

#endif
