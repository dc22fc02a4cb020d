/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file report.h
 * \brief Reports for users and programs: report.html and its figures (SVG documents), summary.json, and terminal output.
 */
#ifndef trackPattern_report_h
#define trackPattern_report_h

#include "options.h"
#include "results.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace trackPattern
{
//! Displacement per image, measured and, where known, true.
[[nodiscard]] std::string motionFigure(const RunResults &results);
//! Displacement per image, measured minus true. Only with ground truth.
[[nodiscard]] std::string errorFigure(const RunResults &results);
//! Reported standard deviation of a cell and of the displacement per image, after learning.
[[nodiscard]] std::string sigmaFigure(const RunResults &results);
//! Histogram of the tracker's time per image.
[[nodiscard]] std::string timeFigure(const RunResults &results);
//! Status of every image as a strip.
[[nodiscard]] std::string statusFigure(const RunResults &results);

//! \brief Map of the cells' deviations, with its data.
struct DeviationMap {
  std::string svg; //!< Empty if there is nothing to show.
  std::size_t cells = 0;
  double factor = 1.;          //!< Magnification of the arrows.
  double rmsX = 0., rmsY = 0.; //!< px.
};
//! Map of the epoch with the most cells.
[[nodiscard]] DeviationMap deviationMap(const RunResults &results);

//! Results in a few sentences.
[[nodiscard]] std::vector<std::string> findings(const RunResults &results);
//! report.html. \param video : The bytes of overlay.mp4, shown in the page; empty: none. \param commandLine : As typed.
[[nodiscard]] std::string reportPage(const RunResults &results, const Options &options, const std::string &video,
                                     const std::string &commandLine);
//! summary.json without the fields added by OutputFolder.
[[nodiscard]] nlohmann::ordered_json summaryOf(const RunResults &results, const Options &options,
                                               const std::string &commandLine);
} // namespace trackPattern

#endif
