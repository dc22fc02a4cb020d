/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file reportPage.h
 * \brief The report page of visp-print-pattern, and its plots.
 */
#ifndef printPattern_reportPage_h
#define printPattern_reportPage_h

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

//! \brief Content of the page besides the numbers.
struct ReportParts {
  std::vector<Figure> own;    //!< Figures of the user's run.
  std::vector<Figure> thesis; //!< Figures of the thesis's experiments; may be empty.
  std::string printed;        //!< The printed product, PNG.
  std::string detection;      //!< Figure 7.11, PNG; empty without the thesis's experiments.
  std::string video;          //!< File beside the page, or empty.
  std::string commandLine;    //!< Command line of the run.
};

//! The page, self-contained except for the video.
[[nodiscard]] std::string reportPage(const Options &options, const Results &results, const ReportParts &parts);
} // namespace printPattern

#endif
