/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file reportPage.h
 * \brief report.html of a run.
 */
#ifndef avoidObstacle_reportPage_h
#define avoidObstacle_reportPage_h

#include "results.h"

#include "htmlReport.h"

namespace avoidObstacle
{
//! \brief A video beside the page.
struct FilmFile {
  std::string name; //!< In the result folder; empty: none.
  bool forBrowsers = true;
  std::string bytes; //!< File content.
};

//! Adds a figure to a page.
void addFigure(vpApp::HtmlReport &page, const Figure &figure);
//! The page.
[[nodiscard]] std::string reportPage(const PhotoScene &scene, const Options &options, const Episode &episode,
                                     const std::vector<Figure> &figures, const FilmFile &film,
                                     const std::string &commandLine);
//! The page of a reproduced figure.
[[nodiscard]] std::string replicaPage(const Replica &replica, const std::string &commandLine);
} // namespace avoidObstacle

#endif
