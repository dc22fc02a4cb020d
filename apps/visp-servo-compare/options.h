/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-servo-compare.
 */
#ifndef servoCompare_options_h
#define servoCompare_options_h

#include "robotOptions.h"

#include <string>
#include <vector>

namespace servoCompare
{
//! \brief The robot that carries the camera; "camera" flies freely.
struct RobotOptions : vpApp::RobotOptions {
  RobotOptions()
  {
    robot = "camera";
    words = {"camera", "amor"};
  }
  std::vector<std::string> selfMotion{"limits", "manipulability"}; //!< Indices maximised by self-motion.
  std::vector<std::string> free;                                   //!< Axes of the camera that are not commanded.
  std::string limits = "stop";                                     //!< At position limits: "stop" or "scale".
  std::string drive = "integrated"; //!< The drives' reference: "integrated" or "measured".
};

//! \brief User options, not yet resolved or checked for consistency.
struct Options {
  std::vector<std::string> laws;     //!< Ids; empty for all.
  std::vector<std::string> plants;   //!< Names; empty for all.
  std::vector<std::string> measures; //!< "points", "image"; empty for the default choice.
  bool full = false;                 //!< All combinations.
  bool shape = false;                //!< Repeat each run with a shaped twist.
  bool bounded = false;              //!< Every law within the same limits of the motion, with the object averaged.
  double lambda = 0.;                //!< Gain instead of that of the task, 1/s; 0: that of the task.
  std::string taskFile;              //!< Empty for the task of the thesis.
  std::string target;                //!< Photo of the object; empty for that of data/.
  unsigned int repetitions = 1;      //!< Seeds per run.
  unsigned int seed = 1;             //!< The first seed.
  std::string out = "out/servo-compare";
  bool display = false;
  unsigned int jobs = 0; //!< Runs at a time; 0: one for each core.
  bool list = false;
  RobotOptions robot;
};

/*!
 * Read the command line.
 * \return False when `--help` or `--version` was requested and printed.
 * \throw vpApp::UsageError naming the option.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);
} // namespace servoCompare

#endif
