/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file reportPage.h
 * \brief report.html.
 */
#ifndef thesisReport_reportPage_h
#define thesisReport_reportPage_h

#include "run.h"

namespace thesisReport
{
//! The page, with embedded figures.
[[nodiscard]] std::string reportPage(const std::vector<Played> &all, const std::string &commandLine, double wallTime);
} // namespace thesisReport

#endif
