/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file plot.h
 * \brief Line plots as SVG or PNG, drawn by the program gnuplot.
 */
#ifndef vpApp_plot_h
#define vpApp_plot_h

#include "curves.h"

namespace vpApp
{
/*!
 * Check that gnuplot is available, before hours of work whose result could not be plotted.
 * \throw std::runtime_error explaining how to install it.
 */
void requireGnuplot();

/*!
 * The plot as an SVG document. May be called from several threads.
 * \throw std::runtime_error with gnuplot's complaint.
 */
[[nodiscard]] std::string renderSvg(const Plot &plot);

//! File format of a figure.
enum class PlotFormat { Svg, Png };

/*!
 * Plots below each other in one figure, as wide as the widest, with the same margins, so that their x axes are
 * aligned.
 * \param panels : From top to bottom, at least one.
 * \throw std::runtime_error with gnuplot's complaint.
 */
[[nodiscard]] std::string renderPanels(const std::vector<Plot> &panels, PlotFormat format);
} // namespace vpApp

#endif
