/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file selfMotion.h
 * \brief S5: the three indices, figures 8.14 to 8.17.
 */
#ifndef planCompare_selfMotion_h
#define planCompare_selfMotion_h

#include "plan.h"

#include "lab/arm/vpSelfMotionExperiment.h"

namespace planCompare
{
//! \brief One index with one share of self-motion.
struct SelfMotionRow {
  std::string index; //!< "point".
  std::string sense; //!< "attract", "repel"; "none" without self-motion.
  double share = 0.; //!< |eta|
  vpSelfMotionRun run;
};

//! Runs S5; empty if it was not requested. \throw vpException for an arm with fewer than four joints.
[[nodiscard]] std::vector<SelfMotionRow> runSelfMotion(const Plan &plan);
} // namespace planCompare

#endif
