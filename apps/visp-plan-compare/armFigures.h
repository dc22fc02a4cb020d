/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file armFigures.h
 * \brief Arm figures and animations of the shown runs.
 */
#ifndef planCompare_armFigures_h
#define planCompare_armFigures_h

#include "figures.h"

namespace planCompare
{
//! Tool paths of all methods, and the arm of one of them at some times.
[[nodiscard]] Figure drawArm(const Plan &plan, const Results &results, const SceneInfo &scene);
//! Animation of that arm and the obstacles.
[[nodiscard]] Figure animateArm(const Plan &plan, const Results &results, const SceneInfo &scene);
} // namespace planCompare

#endif
