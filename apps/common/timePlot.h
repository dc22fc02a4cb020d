/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file timePlot.h
 * \brief Plots over time.
 */
#ifndef vpApp_timePlot_h
#define vpApp_timePlot_h

#include "plot.h"

#include <cstddef>
#include <functional>

namespace vpApp
{
//! Value shown for merged neighbours, so that peaks or valleys are kept.
enum class Keep { Largest, Least };

/*!
 * A curve of at most about 800 points.
 * \param count : Number of values. \param time, value : Functions of the index 0 ... count - 1.
 */
[[nodiscard]] PlotCurve timeCurve(const std::string &label, const std::string &colour, std::size_t count,
                                  const std::function<double(std::size_t)> &time,
                                  const std::function<double(std::size_t)> &value, Keep keep = Keep::Largest);
//! Curve of stored values.
[[nodiscard]] PlotCurve timeCurve(const std::string &label, const std::string &colour, const std::vector<double> &times,
                                  const std::vector<double> &values, Keep keep = Keep::Largest);
} // namespace vpApp

#endif
