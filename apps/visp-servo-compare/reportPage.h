/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file reportPage.h
 * \brief The report page.
 */
#ifndef servoCompare_reportPage_h
#define servoCompare_reportPage_h

#include "figures.h"
#include "replay.h"

namespace servoCompare
{
//! \brief Content of the page besides plan and results.
struct ReportParts {
  std::vector<Figure> armFigures; //!< Figures of the joints; empty without an arm.
  std::vector<Figure> figures;
  std::optional<Figure> step; //!< Figure of the section on shaped runs, if any.
  FilmStrip filmStrip;
  std::vector<ReplayVideo> videos;
  std::string commandLine;
  double wallTime = 0.; //!< s
};

/*!
 * The page as HTML. \param out : Folder of the videos.
 */
[[nodiscard]] std::string reportPage(const Plan &plan, const Results &results, const ReportParts &parts,
                                     vpApp::OutputFolder &out);
} // namespace servoCompare

#endif
