/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file influencePlot.h
 * \brief What each variable does to the first objective.
 */
#ifndef printExplore_influencePlot_h
#define printExplore_influencePlot_h

#include "explorationPlots.h"

namespace printExplore
{
//! A panel for each variable that varies: all designs that work, the best one and the median at each value.
[[nodiscard]] Plotted influencePlot(const Setup &setup, const Exploration &result);
} // namespace printExplore

#endif
