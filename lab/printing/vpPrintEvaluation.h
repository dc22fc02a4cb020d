/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Metrics of a print experiment, from the true motion.
#ifndef vpPrintEvaluation_h
#define vpPrintEvaluation_h

#include "lab/printing/vpPrintExperiment.h"

#include <vector>

BEGIN_VISP_NAMESPACE

//! \brief Passage of a cell at the nozzle.
struct vpPrintPass {
  int row, column;
  double time;     //!< Time, frames.
  double velocity; //!< Velocity in the printing direction, px/frame.
  double x;        //!< True position of the cell at displacement 0, px.
};

/*!
 * Computes the metrics of \e run, and sorts its drops by landing time.
 * \param passes : Passages in printing order.
 * \param end : End time of the run, frames.
 */
void vpEvaluatePrintRun(vpPrintRun &run, const std::vector<vpPrintPass> &passes, double end);

END_VISP_NAMESPACE
#endif
