/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file influencePlot.h
 * \brief Influence of each variable on the first objective.
 */
#ifndef printExplore_influencePlot_h
#define printExplore_influencePlot_h

#include "explorationPlots.h"

namespace printExplore
{
//! One panel per varying variable: all feasible designs, the best one and the median at each value.
[[nodiscard]] Plotted influencePlot(const Setup &setup, const Exploration &result);
} // namespace printExplore

#endif
