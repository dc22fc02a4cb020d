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

#include <string>
#include <utility>
#include <vector>

namespace vpApp
{
//! How a curve is drawn.
enum class PlotStyle { Solid, Dashed, Dotted, Points, Rings };

//! \brief One curve. A point that is not finite interrupts the line.
struct PlotCurve {
  std::string label;              //!< Legend; empty for none.
  std::string colour = "#000000"; //!< #rrggbb.
  PlotStyle style = PlotStyle::Solid;
  double width = 2.;
  std::vector<double> x; //!< As many as #y.
  std::vector<double> y;
};

//! \brief A vertical line at \e x with a text at its top.
struct PlotMark {
  double x = 0.;
  std::string label;
};

//! \brief What to plot. The range of x is free where minimum = maximum.
struct Plot {
  std::string title;
  std::string xLabel; //!< With unit: "time (s)".
  std::string yLabel; //!< With unit.
  std::vector<PlotCurve> curves;
  std::vector<PlotMark> marks;
  std::vector<std::string> categories; //!< Names for x = 0, 1, 2 ... instead of numbers.
  std::pair<double, double> xRange{0., 0.};
  bool fromZero = false;  //!< y begins at 0.
  bool equalAxes = false; //!< One unit is as long on x as on y: maps.
  bool logX = false;      //!< Powers of ten are equally far apart on x (1k, 10k, ...); points at x <= 0 are left out.
  bool logY = false;      //!< The same on y. Not with #fromZero.
  unsigned int width = 960;
  unsigned int height = 440;
};

/*!
 * Make sure that gnuplot is there, before hours of work are done whose result could not be shown.
 * \throw std::runtime_error saying how to install it.
 */
void requireGnuplot();

/*!
 * The plot as an SVG document. May be called from several threads.
 * \throw std::runtime_error with gnuplot's complaint.
 */
[[nodiscard]] std::string renderSvg(const Plot &plot);

//! What a picture is written as.
enum class PlotFormat { Svg, Png };

/*!
 * Plots below each other in one picture, as wide as the widest, with the same margins, so that the same x stands at the
 * same place in all of them.
 * \param panels : From top to bottom, at least one.
 * \throw std::runtime_error with gnuplot's complaint.
 */
[[nodiscard]] std::string renderPanels(const std::vector<Plot> &panels, PlotFormat format);
} // namespace vpApp

#endif
