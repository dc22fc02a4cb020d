/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The figures of a print experiment, from what truly happened.
#ifndef vpPrintEvaluation_h
#define vpPrintEvaluation_h

#include "lab/printing/vpPrintExperiment.h"

#include <vector>

BEGIN_VISP_NAMESPACE

//! \brief A cell at the nozzle.
struct vpPrintPass {
  int row, column;
  double time;     //!< frame
  double velocity; //!< In the direction of printing, px/frame.
  double x;        //!< True place of the cell at displacement 0, px.
};

/*!
 * Set the metrics of \e run, and order its drops by landing.
 * \param passes : In the order of printing.
 * \param end : Time at which the run ended, frame.
 */
void vpEvaluatePrintRun(vpPrintRun &run, const std::vector<vpPrintPass> &passes, double end);

END_VISP_NAMESPACE
#endif
