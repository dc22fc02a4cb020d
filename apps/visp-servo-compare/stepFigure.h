/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file stepFigure.h
 * \brief The first second of a run, raw and shaped: the jump of velocity at the start and the ramp in its place.
 */
#ifndef servoCompare_stepFigure_h
#define servoCompare_stepFigure_h

#include "figures.h"

namespace servoCompare
{
/*!
 * Speed and acceleration of the command from a little before it begins until a second later, of PBVS-1 if it was run,
 * otherwise of the first law, on the easiest plant.
 * \param plan : With Plan::shaped.
 */
[[nodiscard]] Figure drawStep(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
