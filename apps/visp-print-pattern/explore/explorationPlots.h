/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file explorationPlots.h
 * \brief Pictures of an exploration.
 */
#ifndef printExplore_explorationPlots_h
#define printExplore_explorationPlots_h

#include "exploration.h"

#include <string>
#include <vector>

namespace printExplore
{
//! \brief A picture as SVG.
struct Plotted {
  std::string name;    //!< File name without extension.
  std::string alt;     //!< What it shows, in words.
  std::string caption; //!< Below it.
  std::string svg;
};

/*!
 * The front in the plane of the first two objectives, by controller and by load; what each variable does to the first objective;
 * which cameras can work (figure 7.1 of the thesis).
 */
[[nodiscard]] std::vector<Plotted> explorationPlots(const Setup &setup, const Exploration &result);
} // namespace printExplore

#endif
