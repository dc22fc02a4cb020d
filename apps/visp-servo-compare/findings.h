/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file findings.h
 * \brief What the numbers say, in sentences: computed, never written beforehand.
 */
#ifndef servoCompare_findings_h
#define servoCompare_findings_h

#include "results.h"

namespace servoCompare
{
//! \brief Sentences on a finished comparison.
struct Findings {
  std::vector<std::string> answer; //!< One or two sentences: who arrives, and what is left at equal gain.
  std::vector<std::string> more;   //!< Further ones, for a list.
};

//! Draw the conclusions, from medians over the seeds. What was not run is not spoken of.
[[nodiscard]] Findings findingsOf(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
