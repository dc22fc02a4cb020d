/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-thesis-report.
 */
#ifndef thesisReport_options_h
#define thesisReport_options_h

#include <string>
#include <vector>

namespace thesisReport
{
//! \brief User options.
struct Options {
  std::vector<std::string> only; //!< Requested ids; all of them by default.
  std::string out = "out/thesis-report";
  unsigned int jobs = 0; //!< Parts at a time; 0: one for each core.
  unsigned int seed = 1;
  bool list = false;
};

/*!
 * Read the command line.
 * \return False when `--help` or `--version` was requested and printed.
 * \throw vpApp::UsageError naming the option and its value.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);
} // namespace thesisReport

#endif
