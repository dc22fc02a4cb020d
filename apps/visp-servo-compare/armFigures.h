/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file armFigures.h
 * \brief Plots of the joints over time.
 */
#ifndef servoCompare_armFigures_h
#define servoCompare_armFigures_h

#include "figures.h"

namespace servoCompare
{
//! The law whose joints are shown: the default of visp-direct if it was run, else the first.
[[nodiscard]] std::string armLaw(const Plan &plan);

/*!
 * Joint angles, speeds, distances to the limits and self-motion on the hardest plant, and joint errors; empty without
 * an arm.
 */
[[nodiscard]] std::vector<Figure> drawArmFigures(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
