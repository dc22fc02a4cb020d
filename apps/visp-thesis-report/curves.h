/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file curves.h
 * \brief Curves of plots, one line of code each.
 */
#ifndef thesisReport_curves_h
#define thesisReport_curves_h

#include "timePlot.h"

#include <string>
#include <vector>

namespace thesisReport
{
//! Colours distinguishable with colour blindness, in order of use.
[[nodiscard]] const std::string &colour(std::size_t i);

//! Add a curve in the next colour.
void addCurve(vpApp::Plot &plot, const std::string &label, std::vector<double> x, std::vector<double> y,
              vpApp::PlotStyle style = vpApp::PlotStyle::Solid);

//! A dashed grey line at \e value (and at -value when \e both) over the width of the curves so far.
void addBound(vpApp::Plot &plot, double value, bool both, const std::string &label = "bound");
} // namespace thesisReport

#endif
