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

#include <string>
#include <vector>

namespace servoCompare
{
//! \brief What the user asked for, not yet looked up or checked against each other.
struct Options {
  std::vector<std::string> laws;     //!< Ids; empty for all.
  std::vector<std::string> plants;   //!< Names; empty for all.
  std::vector<std::string> measures; //!< "points", "image"; empty for the default choice.
  bool full = false;                 //!< Everything with everything.
  bool shape = false;                //!< Each run a second time with its twist shaped.
  std::string taskFile;              //!< Empty for the task of the thesis.
  std::string target;                //!< Photo of the object; empty for the one of data/.
  unsigned int repetitions = 1;      //!< Seeds a run.
  unsigned int seed = 1;             //!< The first seed.
  std::string out = "out/servo-compare";
  bool display = false;
  unsigned int jobs = 1;
  bool list = false;
};

/*!
 * Read the command line.
 * \return False when `--help` or `--version` was asked for, and printed.
 * \throw vpApp::UsageError naming the option.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);

//! Version of visp-direct and of ViSP.
[[nodiscard]] std::string versionText();
} // namespace servoCompare

#endif
