/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file explorationPage.h
 * \brief The page of an exploration.
 */
#ifndef printExplore_explorationPage_h
#define printExplore_explorationPage_h

#include "explorationPlots.h"

namespace printExplore
{
//! The page, self-contained.
[[nodiscard]] std::string explorationPage(const Setup &setup, const Exploration &result,
                                          const std::vector<Plotted> &plots, const std::string &commandLine);
} // namespace printExplore

#endif
