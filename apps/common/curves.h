/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file curves.h
 * \brief Curves of a figure, as data.
 */
#ifndef vpApp_curves_h
#define vpApp_curves_h

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

//! An empty plot against time in s. \param yLabel : With unit.
[[nodiscard]] Plot timePlot(const std::string &title, const std::string &yLabel, unsigned int height = 260);

//! A dashed horizontal line over the width of the curves so far, and over Plot::xRange if set.
void addLevel(Plot &plot, double level, const std::string &label);
} // namespace vpApp

#endif
