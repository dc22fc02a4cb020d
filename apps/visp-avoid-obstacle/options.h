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

#include <string>
#include <utility>
#include <vector>

namespace avoidObstacle
{
//! \brief How obstacles are seen.
enum class SensorKind {
  Image, //!< Photographs in pictures of the camera in the hand.
  Depth, //!< Depth images of the camera in the hand, as a map of cubes.
  Poses  //!< Poses with noise: a vision system that always finds what is in range.
};

//! \brief What the user asked for, not yet looked up.
struct Options {
  std::string method = "dtg-via";
  std::string scene;   //!< JSON file; empty for the default scene.
  std::string arm;     //!< JSON file; empty for AMOR.
  std::string targets; //!< Folder with targets.json; empty for the data folder's.
  SensorKind sensor = SensorKind::Image;
  std::vector<std::pair<double, double>> hidden; //!< The camera is covered from, until; s.
  double visionRate = 30.;                       //!< Hz.
  double latency = 0.05;                         //!< s.
  double duration = 20.;                         //!< At most, s.
  double forget = 0.;                            //!< What is not seen for so long is not there any more, s; 0: never.
  double noise = 2.;                             //!< Of pictures, grey values.
  double friction = 1.;                          //!< Of the joints, relative to the arm's file; 0: ideal drives.
  unsigned int seed = 1;
  std::string replica; //!< Name of a figure; empty for none.
  std::string out = "out/avoid-obstacle";
  bool record = false;  //!< Write a video.
  bool display = false; //!< Show it in a window, too.
  bool list = false;
};

//! "image", "depth" or "poses".
[[nodiscard]] const char *nameOf(SensorKind kind);

/*!
 * Read the command line.
 * \return False when `--help` or `--version` was asked for, and printed.
 * \throw vpApp::UsageError naming the option and its value.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);

//! Exit status beside those of vpApp::ExitStatus: there is a report, and in it the moving arm hits something.
constexpr int ExitHit = 3;

} // namespace avoidObstacle

#endif
