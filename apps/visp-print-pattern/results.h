/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief The runs of visp-print-pattern, and their figures.
 */
#ifndef printPattern_results_h
#define printPattern_results_h

#include "identification.h"
#include "options.h"

#include <optional>

#include <string>
#include <vector>

namespace printPattern
{
//! \brief Distribution of the landing errors over all drops of all runs, um from the true centre of the cell.
struct Landing {
  std::vector<double> errors; //!< Distances, ascending.
  double p50 = 0.;            //!< Median.
  double p99 = 0.;            //!< 99th percentile.
  double max = 0.;            //!< Largest.
  double within = 0.;         //!< Share within #tolerance, 0..1.

  static constexpr double tolerance = 10.; //!< um: that of the thesis.
};

//! \brief An experiment of the thesis, repeated.
struct Replica {
  std::string figure;                //!< "7.13".
  std::string name;                  //!< "PID".
  double thesis = 0.;                //!< Velocity error that the thesis gives, rms, px/frame; 0: none.
  std::vector<vpPrintRun> runs;      //!< With different seeds; the first one is drawn.
  double rms_velocity_error = 0.;    //!< Of all runs together, px/frame.
  double centre_velocity_error = 0.; //!< The same at the centres.
};

//! \brief All that was run.
struct Results {
  std::optional<Identification> identification; //!< With --identify.
  std::vector<vpPrintRun> runs;                 //!< Of the user's specification; the first one is drawn.
  Landing landing;                              //!< Of these.
  std::vector<Replica> replicas;                //!< Experiments of the thesis, by figure; may be empty.
  std::vector<Replica> observers;               //!< The same task with the observer: thesis's sensor, and our tracker.
};

/*!
 * Run everything, several runs at a time, with progress on stderr.
 * \throw vpApp::Interrupted after Ctrl-C.
 */
[[nodiscard]] Results runAll(const Options &options);
//! Landing errors of some runs.
[[nodiscard]] Landing landingOf(const std::vector<vpPrintRun> &runs);
//! Root mean square of a figure over the runs.
[[nodiscard]] double rmsOf(const std::vector<vpPrintRun> &runs, double vpPrintMetrics::*figure);
//! Mean of a figure over the runs.
[[nodiscard]] double meanOf(const std::vector<vpPrintRun> &runs, double vpPrintMetrics::*figure);
//! Sum of a count over the runs.
[[nodiscard]] int sumOf(const std::vector<vpPrintRun> &runs, int vpPrintMetrics::*count);
} // namespace printPattern

#endif
