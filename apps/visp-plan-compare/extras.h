/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file extras.h
 * \brief What is computed besides the runs. S4: cost of certified checks for a planner, and collisions missed by samples.
 * S5: the three indices, figures 8.14 to 8.17.
 */
#ifndef planCompare_extras_h
#define planCompare_extras_h

#include "plan.h"

#include "lab/arm/vpSelfMotionExperiment.h"

namespace planCompare
{
//! \brief A planner with one motion validator, over the tasks of a scene and many seeds.
struct ValidatorRow {
  std::string scene;
  std::string planner;   //!< "BiRRT", "RRTConnect".
  std::string validator; //!< "certified", "samples, own distances", "samples, FCL".
  int plans = 0;
  int solved = 0;
  double p50 = 0.; //!< Planning time, ms.
  double p95 = 0.;
  double length = 0.; //!< Median length of the paths, rad; NaN without any.
  int colliding = 0;  //!< Paths found in collision when rechecked at 10,000 configurations.
};

//! Compares the validators, one plan at a time, as times are the result. Empty if S4 was not requested.
[[nodiscard]] std::vector<ValidatorRow> compareValidators(const Plan &plan);

//! \brief One index with one share of self-motion.
struct SelfMotionRow {
  std::string index; //!< "point".
  std::string sense; //!< "attract", "repel"; "none" without self-motion.
  double share = 0.; //!< |eta|
  vpSelfMotionRun run;
};

//! Runs S5; empty if it was not requested. \throw vpException for an arm with fewer than four joints.
[[nodiscard]] std::vector<SelfMotionRow> runSelfMotion(const Plan &plan);

//! \brief Results computed besides the runs.
struct Extras {
  std::vector<ValidatorRow> validators;
  std::vector<SelfMotionRow> selfMotion;
  std::string commandLine;
  double wallTime = 0.; //!< Total wall time, s.
};
} // namespace planCompare

#endif
