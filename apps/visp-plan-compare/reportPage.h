/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file reportPage.h
 * \brief report.html.
 */
#ifndef planCompare_reportPage_h
#define planCompare_reportPage_h

#include "figures.h"

namespace planCompare
{
//! The whole page, self-contained.
[[nodiscard]] std::string reportPage(const Plan &plan, const Results &results, const Extras &extras,
                                     const std::vector<Figure> &figures);
} // namespace planCompare

#endif
