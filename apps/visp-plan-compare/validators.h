/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file validators.h
 * \brief S4: cost of certified checks for a planner, and collisions missed by samples.
 */
#ifndef planCompare_validators_h
#define planCompare_validators_h

#include "plan.h"

namespace planCompare
{
//! \brief RRTConnect with one motion validator, over the tasks of a scene and many seeds.
struct ValidatorRow {
  std::string scene;
  std::string validator; //!< "certified", "samples, own distances", "samples, FCL".
  int plans = 0;
  int solved = 0;
  double p50 = 0.; //!< Planning time, ms.
  double p95 = 0.;
  int colliding = 0; //!< Paths found in collision when rechecked at 10,000 configurations.
};

//! Compares the validators, one plan at a time, as times are the result. Empty if S4 was not requested.
[[nodiscard]] std::vector<ValidatorRow> compareValidators(const Plan &plan);
} // namespace planCompare

#endif
