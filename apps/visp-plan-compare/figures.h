/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file figures.h
 * \brief Plots, pictures of the arm and animations of the shown runs.
 */
#ifndef planCompare_figures_h
#define planCompare_figures_h

#include "results.h"
#include "selfMotion.h"

namespace planCompare
{
//! \brief A figure, ready for the page: a drawing, or a piece of HTML.
struct Figure {
  std::string scene;   //!< Id: the section where it stands.
  std::string name;    //!< File name without suffix: "S3-arm".
  std::string title;   //!< In a few words.
  std::string caption; //!< What to see.
  std::string svg;     //!< The drawing; or empty.
  std::string html;    //!< An animation; or empty.
};

//! The method of a scene that is drawn as an arm: most successes, then the shortest median duration.
[[nodiscard]] std::string heroOf(const Plan &plan, const Results &results, const std::string &scene);

/*!
 * Draw all figures that the runs allow.
 * \param jobs : Figures drawn at a time.
 */
[[nodiscard]] std::vector<Figure> drawFigures(const Plan &plan, const Results &results,
                                              const std::vector<SelfMotionRow> &selfMotion, unsigned int jobs);
} // namespace planCompare

#endif
