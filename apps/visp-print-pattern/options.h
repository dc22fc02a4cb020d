/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-print-pattern.
 */
#ifndef printPattern_options_h
#define printPattern_options_h

#include "lab/printing/vpPrintExperiment.h"

#include <string>

namespace printPattern
{
VISP_DIRECT_USING_NAMESPACE

//! \brief User options.
struct Options {
  vpPrintExperimentSpec spec;            //!< The user's run.
  std::string sensor = "image";          //!< image, tracker or thesis; the last two are models of a sensor.
  int runs = 1;                          //!< Number of runs with different seeds, for statistics.
  bool replicas = true;                  //!< Also run the experiments of the thesis.
  bool identify = false;                 //!< First identify mass and friction of the stage from a ramp.
  bool video = false;                    //!< Write camera.mp4.
  unsigned int jobs = 0;                 //!< Parallel runs, 0: one per core.
  std::string out = "out/print-pattern"; //!< Result folder.
  std::string explore;                   //!< Exploration file; if set, only #jobs and #out are used besides.
};

/*!
 * Read the command line.
 * \return False when the program has nothing left to do (`--help`, `--version`).
 * \throw vpApp::UsageError naming the option and its value.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);
} // namespace printPattern

#endif
