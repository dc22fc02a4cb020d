/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-arm.
 */
#ifndef armProgram_options_h
#define armProgram_options_h

#include "robotOptions.h"

#include <string>
#include <vector>

namespace armProgram
{
//! \brief User options.
struct Options {
  vpApp::RobotOptions robot;
  bool json = false;        //!< JSON instead of text on standard output.
  std::string out;          //!< Folder for data and report; empty: none.
  std::vector<double> fk;   //!< Configuration whose pose is asked for, rad or m; empty: none.
  std::string touches;      //!< Scene whose contacts with the arm are asked for; empty: none.
  std::vector<double> at;   //!< Configuration for #touches.
  std::string writtenPairs; //!< File for the pairs that need no check; empty: none.
};

/*!
 * Read the command line.
 * \return False when `--help` or `--version` was requested and printed.
 * \throw vpApp::UsageError naming the option and its value.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);
} // namespace armProgram

#endif
