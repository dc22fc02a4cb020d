/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file planePlots.h
 * \brief Plots of motions in the plane, as in the figures of chapter 8.
 */
#ifndef avoidObstacle_planePlots_h
#define avoidObstacle_planePlots_h

#include "figures.h"

#include "timePlot.h"

namespace avoidObstacle
{
//! Path as a curve. \param thin : Keep every thin-th point.
[[nodiscard]] vpApp::PlotCurve wayCurve(const std::string &label, const std::string &colour,
                                        const std::vector<Eigen::Vector2d> &way, std::size_t thin = 1);
//! Single positions as points.
[[nodiscard]] vpApp::PlotCurve placeCurve(const std::string &label, const std::string &colour,
                                          const std::vector<Eigen::Vector2d> &places);
//! Map: x to the right, y up, to scale.
[[nodiscard]] vpApp::Plot wayPlot(const std::string &title);
} // namespace avoidObstacle

#endif
