/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file figures.h
 * \brief The plots of visp-print-pattern.
 */
#ifndef printPattern_figures_h
#define printPattern_figures_h

#include "results.h"

#include <string>
#include <vector>

namespace printPattern
{
//! \brief A plot as SVG.
struct Figure {
  std::string name;    //!< File name without extension, "figure-7.13".
  std::string alt;     //!< Alternative text.
  std::string caption; //!< Caption.
  std::string svg;
};

//! Plots of the user's run: velocity, landing errors from cell to cell, their histogram.
[[nodiscard]] std::vector<Figure> ownFigures(const Results &results);
//! Figures 7.12 to 7.15, and their task with the observer.
[[nodiscard]] std::vector<Figure> thesisFigures(const Results &results);
//! Figure 7.10: displacement of a pixel by radial distortion.
[[nodiscard]] Figure distortionFigure();
} // namespace printPattern

#endif
