/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file explorationPlots.h
 * \brief Figures of an exploration.
 */
#ifndef printExplore_explorationPlots_h
#define printExplore_explorationPlots_h

#include "exploration.h"

#include <string>
#include <vector>

namespace printExplore
{
//! \brief A figure as SVG.
struct Plotted {
  std::string name;    //!< File name without extension.
  std::string alt;     //!< Alternative text.
  std::string caption; //!< Caption.
  std::string svg;
};

/*!
 * The front in the plane of the first two objectives, by controller and by load; influence of each variable on the
 * first objective; feasible cameras (figure 7.1 of the thesis).
 */
[[nodiscard]] std::vector<Plotted> explorationPlots(const Setup &setup, const Exploration &result);
} // namespace printExplore

#endif
