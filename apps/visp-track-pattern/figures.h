/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file figures.h
 * \brief The figures of the report, each an SVG document.
 */
#ifndef trackPattern_figures_h
#define trackPattern_figures_h

#include "results.h"

#include <string>

namespace trackPattern
{
//! Displacement per image, measured and, where known, true.
[[nodiscard]] std::string motionFigure(const RunResults &results);
//! Displacement per image, measured minus true. Only with ground truth.
[[nodiscard]] std::string errorFigure(const RunResults &results);
//! Reported standard deviation of a cell and of the displacement per image, after learning.
[[nodiscard]] std::string sigmaFigure(const RunResults &results);
//! Histogram of the tracker's time per image.
[[nodiscard]] std::string timeFigure(const RunResults &results);
//! Status of every image as a strip.
[[nodiscard]] std::string statusFigure(const RunResults &results);

//! \brief Map of the cells' deviations, with its data.
struct DeviationMap {
  std::string svg; //!< Empty if there is nothing to show.
  std::size_t cells = 0;
  double factor = 1.;          //!< Magnification of the arrows.
  double rmsX = 0., rmsY = 0.; //!< px.
};
//! Map of the epoch with the most cells.
[[nodiscard]] DeviationMap deviationMap(const RunResults &results);
} // namespace trackPattern

#endif
