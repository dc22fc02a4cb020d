/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-generate-pattern.
 */
#ifndef generatePattern_options_h
#define generatePattern_options_h

#include "task.h"

#include <string>

namespace generatePattern
{
//! \brief User options.
struct Options {
  Task task;                                //!< From the file of --config, then from the other options.
  std::string out = "out/generate-pattern"; //!< Result folder.
  std::string format = "png";               //!< Image format of the frames, "png" or "pgm".
  bool video = false;                       //!< Write video.mp4.
  double videoRate = 25.;                   //!< Frames per second of the video, 1..240.
};

/*!
 * Read the command line and the file that it names.
 * \return False when the program has nothing left to do (`--help`, `--version`).
 * \throw vpApp::UsageError naming the option and its value; std::runtime_error naming file, field and value.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);
} // namespace generatePattern

#endif
