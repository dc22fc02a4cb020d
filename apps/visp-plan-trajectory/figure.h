/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file figure.h
 * \brief Plot of a motion: position, velocity, acceleration, jerk over time, with limits and events.
 */
#ifndef planTrajectory_figure_h
#define planTrajectory_figure_h

#include "motion.h"
#include "plot.h"

#include <string>

namespace planTrajectory
{
/*!
 * Draw a motion. Solid: executed motion; thin: continuation of a plan without the next event; dashed: current
 * limits; dotted: goal; grey vertical lines: events; dots: vias.
 * \param title : First line of the figure.
 */
[[nodiscard]] std::string drawMotion(const Problem &problem, const Motion &motion, const std::string &title,
                                     vpApp::PlotFormat format);
} // namespace planTrajectory

#endif
