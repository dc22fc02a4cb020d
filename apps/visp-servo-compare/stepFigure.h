/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file stepFigure.h
 * \brief The first second of a run, raw and shaped: velocity step at the start, and the ramp that replaces it.
 */
#ifndef servoCompare_stepFigure_h
#define servoCompare_stepFigure_h

#include "figures.h"

namespace servoCompare
{
/*!
 * Speed and acceleration of the command from shortly before its start until one second later, for PBVS-1 if it was run,
 * otherwise for the first law, on the easiest plant.
 * \param plan : With Plan::shaped.
 */
[[nodiscard]] Figure drawStep(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
