/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file figures.h
 * \brief The plots of the report: figures 5.6 to 5.10 of the thesis, the camera's path, and the seeds; the joints; a shaped
 * start.
 */
#ifndef servoCompare_figures_h
#define servoCompare_figures_h

#include "results.h"

namespace servoCompare
{
//! \brief A figure for the page.
struct Figure {
  std::string name;    //!< File name without suffix: "figure-5.6".
  std::string svg;     //!< The drawing.
  std::string title;   //!< Short title.
  std::string caption; //!< Explanation, with differences from the thesis.
};

/*!
 * Draw all figures that the runs allow.
 * \param jobs : Figures drawn in parallel.
 */
[[nodiscard]] std::vector<Figure> drawFigures(const Plan &plan, const Results &results, unsigned int jobs);

//! The laws of the figures: those of \e preferred that were run, or the first few that were run.
[[nodiscard]] std::vector<std::string> figureLaws(const Plan &plan, const std::vector<std::string> &preferred);

//! The law whose joints are shown: the default of visp-direct if it was run, else the first.
[[nodiscard]] std::string armLaw(const Plan &plan);

/*!
 * Joint angles, speeds, distances to the limits and self-motion on the hardest plant, and joint errors; empty without
 * an arm.
 */
[[nodiscard]] std::vector<Figure> drawArmFigures(const Plan &plan, const Results &results);

/*!
 * Speed and acceleration of the command from shortly before its start until one second later, for PBVS-1 if it was run,
 * otherwise for the first law, on the easiest plant.
 * \param plan : With Plan::shaped.
 */
[[nodiscard]] Figure drawStep(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
