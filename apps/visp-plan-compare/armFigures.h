/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file armFigures.h
 * \brief The arm of the shown runs, still and moving.
 */
#ifndef planCompare_armFigures_h
#define planCompare_armFigures_h

#include "figures.h"

namespace planCompare
{
//! The ways of all methods' tools, and the arm of one of them at some times.
[[nodiscard]] Figure drawArm(const Plan &plan, const Results &results, const SceneInfo &scene);
//! That arm as it moves, and the obstacles.
[[nodiscard]] Figure animateArm(const Plan &plan, const Results &results, const SceneInfo &scene);
} // namespace planCompare

#endif
