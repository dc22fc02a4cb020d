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
//! Drawing style of a curve.
enum class PlotStyle { Solid, Dashed, Dotted, Points, Rings };

//! \brief One curve. A non-finite point interrupts the line.
struct PlotCurve {
  std::string label;              //!< Legend entry; empty for none.
  std::string colour = "#000000"; //!< #rrggbb.
  PlotStyle style = PlotStyle::Solid;
  double width = 2.;
  std::vector<double> x; //!< Same size as #y.
  std::vector<double> y;
};

//! \brief A vertical line at \e x with a label at its top.
struct PlotMark {
  double x = 0.;
  std::string label;
};

//! \brief Content of a plot. The range of x is automatic if minimum = maximum.
struct Plot {
  std::string title;
  std::string xLabel; //!< With unit: "time (s)".
  std::string yLabel; //!< With unit.
  std::vector<PlotCurve> curves;
  std::vector<PlotMark> marks;
  std::vector<std::string> categories; //!< Names for x = 0, 1, 2 ... instead of numbers.
  std::pair<double, double> xRange{0., 0.};
  bool fromZero = false;  //!< y begins at 0.
  bool equalAxes = false; //!< Equal scale on x and y, for maps.
  bool logX = false;      //!< Logarithmic x (1k, 10k, ...); points at x <= 0 are omitted.
  bool logY = false;      //!< Logarithmic y. Not with #fromZero.
  unsigned int width = 960;
  unsigned int height = 440;
};

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
