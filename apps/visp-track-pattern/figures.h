/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file figures.h
 * \brief The pictures of the report, each an SVG document.
 */
#ifndef trackPattern_figures_h
#define trackPattern_figures_h

#include "results.h"

#include <string>

namespace trackPattern
{
//! Displacement per image, found and, where known, true.
[[nodiscard]] std::string motionFigure(const RunResults &results);
//! Displacement per image, found minus true. Only with truth.
[[nodiscard]] std::string errorFigure(const RunResults &results);
//! Standard deviation of a cell and of the displacement per image, as the tracker says, once it has learned.
[[nodiscard]] std::string sigmaFigure(const RunResults &results);
//! Histogram of the tracker's time per image.
[[nodiscard]] std::string timeFigure(const RunResults &results);
//! Status of every image as a strip.
[[nodiscard]] std::string statusFigure(const RunResults &results);

//! \brief The map of the cells' deviations, and what it shows.
struct DeviationMap {
  std::string svg; //!< Empty when there is nothing to show.
  std::size_t cells = 0;
  double factor = 1.;          //!< The arrows are this much longer than the deviations.
  double rmsX = 0., rmsY = 0.; //!< px.
};
//! Of the epoch with the most cells.
[[nodiscard]] DeviationMap deviationMap(const RunResults &results);
} // namespace trackPattern

#endif
