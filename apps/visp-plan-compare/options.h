/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-plan-compare.
 */
#ifndef planCompare_options_h
#define planCompare_options_h

#include "robotOptions.h"

#include <string>
#include <vector>

namespace planCompare
{
//! \brief User options, not yet resolved.
struct Options {
  std::vector<std::string> scenes;  //!< Ids or files; empty for all.
  std::vector<std::string> methods; //!< Names; empty for all.
  unsigned int seeds = 0;           //!< Seeds per scene; 0: each scene's own number.
  unsigned int firstSeed = 1;
  bool quick = false; //!< A few seeds.
  vpApp::RobotOptions robot;
  double friction = 0.;            //!< Joint friction relative to the arm's file; 0: ideal drives.
  bool compensateFriction = false; //!< The drives' control adds the friction of the arm's file.
  std::string out = "out/plan-compare";
  unsigned int jobs = 0; //!< Runs at a time; 0: one for each core.
  bool list = false;
};

/*!
 * Read the command line.
 * \return False when `--help` or `--version` was requested and printed.
 * \throw vpApp::UsageError naming the option.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);
} // namespace planCompare

#endif
