/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file validators.h
 * \brief S4: what proofs cost a planner, and what samples miss.
 */
#ifndef planCompare_validators_h
#define planCompare_validators_h

#include "plan.h"

namespace planCompare
{
//! \brief RRTConnect with one way of looking at motions, over the tasks of a scene and many seeds.
struct ValidatorRow {
  std::string scene;
  std::string validator; //!< "certified", "samples, own distances", "samples, FCL".
  int plans = 0;
  int solved = 0;
  double p50 = 0.; //!< Planning time, ms.
  double p95 = 0.;
  int colliding = 0; //!< Paths that collide when looked at again at 10,000 places.
};

//! Validators in turn; one plan at a time, since the times are the result. Empty when S4 was not asked for.
[[nodiscard]] std::vector<ValidatorRow> compareValidators(const Plan &plan);
} // namespace planCompare

#endif
