/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief The runs of visp-print-pattern, the user's and those of the thesis, and their metrics.
 */
#ifndef printPattern_results_h
#define printPattern_results_h

#include "options.h"

#include <visp3/printing/vpFrictionIdentification.h>

#include <optional>
#include <string>
#include <vector>

namespace printPattern
{
//! \brief Identified and true parameters of the simulated stage.
struct Identification {
  vpFrictionIdentification found; //!< Identified from the camera's positions.
  vpFrictionModel truth;          //!< True model of the stage, near the start.
  int frames = 0;                 //!< Length of the ramp.
};

//! \brief Distribution of the landing errors over all drops of all runs, um from the true centre of the cell.
struct Landing {
  std::vector<double> errors; //!< Distances, ascending.
  double p50 = 0.;            //!< Median.
  double p99 = 0.;            //!< 99th percentile.
  double max = 0.;            //!< Largest.
  double within = 0.;         //!< Fraction within #tolerance, 0..1.

  static constexpr double tolerance = 10.; //!< um, as in the thesis.
};

//! \brief A repeated experiment of the thesis.
struct Replica {
  std::string figure;                //!< "7.13".
  std::string name;                  //!< "PID".
  double thesis = 0.;                //!< Rms velocity error in the thesis, px/frame; 0: none.
  std::vector<vpPrintRun> runs;      //!< Runs with different seeds; the first one is plotted.
  double rms_velocity_error = 0.;    //!< Rms velocity error over all runs, px/frame.
  double centre_velocity_error = 0.; //!< Rms velocity error at the centres, px/frame.
};

//! \brief All runs.
struct Results {
  std::optional<Identification> identification; //!< With --identify.
  std::vector<vpPrintRun> runs;                 //!< Runs of the user's specification; the first one is plotted.
  Landing landing;                              //!< Landing errors of #runs.
  std::vector<Replica> replicas;                //!< Experiments of the thesis, by figure; may be empty.
  std::vector<Replica> observers;               //!< Same task with the observer: thesis's sensor, and our tracker.
};

/*!
 * Run everything in parallel, with progress on stderr.
 * \throw vpApp::Interrupted after Ctrl-C.
 */
[[nodiscard]] Results runAll(const Options &options);
//! Root mean square of a metric over the runs.
[[nodiscard]] double rmsOf(const std::vector<vpPrintRun> &runs, double vpPrintMetrics::*figure);
//! Mean of a metric over the runs.
[[nodiscard]] double meanOf(const std::vector<vpPrintRun> &runs, double vpPrintMetrics::*figure);
//! Sum of a count over the runs.
[[nodiscard]] int sumOf(const std::vector<vpPrintRun> &runs, int vpPrintMetrics::*count);

/*!
 * The experiments of section 7.3.4 of the thesis: figures 7.12 to 7.15, and their task with the observer;
 * specifications with seeds, not yet run.
 */
[[nodiscard]] std::vector<Replica> thesisReplicas();
//! Compute the metrics over all finished runs.
void summarise(Replica &replica);
} // namespace printPattern

#endif
