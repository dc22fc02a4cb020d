/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file findings.h
 * \brief Results in sentences computed from the numbers.
 */
#ifndef servoCompare_findings_h
#define servoCompare_findings_h

#include "results.h"

namespace servoCompare
{
//! \brief Sentences on a finished comparison.
struct Findings {
  std::vector<std::string> answer; //!< One or two sentences: laws that arrive, and remaining differences at equal gain.
  std::vector<std::string> more;   //!< Further ones, for a list.
};

//! Conclusions from medians over the seeds; only runs that were done are mentioned.
[[nodiscard]] Findings findingsOf(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
