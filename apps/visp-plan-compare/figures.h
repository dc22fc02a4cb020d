/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file figures.h
 * \brief Plots, arm figures and animations of the shown runs.
 */
#ifndef planCompare_figures_h
#define planCompare_figures_h

#include "results.h"

#include "extras.h"

namespace planCompare
{
//! \brief A figure for the page: a drawing, or an HTML fragment.
struct Figure {
  std::string scene;   //!< Scene id: the section of the figure.
  std::string name;    //!< File name without suffix: "S3-arm".
  std::string title;   //!< Short title.
  std::string caption; //!< Explanation.
  std::string svg;     //!< Drawing, or empty.
  std::string html;    //!< Animation, or empty.
};

//! The method whose arm is drawn for a scene: most successes, then the shortest median duration.
[[nodiscard]] std::string heroOf(const Plan &plan, const Results &results, const std::string &scene);

/*!
 * Draw all figures that the runs allow.
 * \param jobs : Figures drawn in parallel.
 */
[[nodiscard]] std::vector<Figure> drawFigures(const Plan &plan, const Results &results,
                                              const std::vector<SelfMotionRow> &selfMotion, unsigned int jobs);
} // namespace planCompare

#endif
