/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file armFigures.h
 * \brief The joints over time.
 */
#ifndef servoCompare_armFigures_h
#define servoCompare_armFigures_h

#include "figures.h"

namespace servoCompare
{
//! The law whose joints are shown: the default of visp-direct where it was run, else the first.
[[nodiscard]] std::string armLaw(const Plan &plan);

/*!
 * Joint angles, speeds, room to the limits and self-motion on the hardest plant, and the joint errors; empty without an
 * arm.
 */
[[nodiscard]] std::vector<Figure> drawArmFigures(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
