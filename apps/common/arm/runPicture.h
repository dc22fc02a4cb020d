/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file runPicture.h
 * \brief A run of an avoidance experiment as a figure and as an animation.
 */
#ifndef vpApp_runPicture_h
#define vpApp_runPicture_h

#include "armPicture.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

namespace vpApp
{
//! Sample at which the tool has covered the fraction \e share of its path, 0..1.
[[nodiscard]] const vpAvoidanceSample &sampleAt(const vpAvoidanceRun &run, double share);
//! The obstacle at its pose at \e time, s.
[[nodiscard]] vpCollisionObject objectAt(const vpMovingObstacle &obstacle, double time);
//! Path of the tool, downsampled.
[[nodiscard]] ArmTrace toolTrace(const vpAvoidanceRun &run, const std::string &label, const std::string &colour);

/*!
 * The arm at the start (grey), at the end (dark) and in between (faint), start and goal, and the obstacles where they
 * are when the tool is half way. The caller adds traces.
 */
[[nodiscard]] ArmPicture runPicture(const vpAvoidanceRun &run, const std::string &title);
//! The first 20 s at 20 frames per second; captions show the status. The caller adds traces.
[[nodiscard]] ArmAnimation runAnimation(const vpAvoidanceRun &run, const std::string &title);
} // namespace vpApp

#endif
