/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-plan-trajectory.
 */
#ifndef planTrajectory_options_h
#define planTrajectory_options_h

#include "plot.h"

#include <string>

namespace planTrajectory
{
//! \brief User options.
struct Options {
  std::string file; //!< Problems; "-": standard input; empty: figure 6.3 of the thesis.
  std::string csv;  //!< File for the samples; empty: none.
  std::string plot; //!< File for the plot, ends in .svg or .png; empty: none.

  //! File format of #plot.
  [[nodiscard]] vpApp::PlotFormat plotFormat() const;
};

/*!
 * Read the command line.
 * \return False when the program has nothing left to do (`--help`, `--version`).
 * \throw vpApp::UsageError naming the option and its value.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);
} // namespace planTrajectory

#endif
