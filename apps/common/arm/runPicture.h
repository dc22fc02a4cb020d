/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file runPicture.h
 * \brief A run of an avoidance experiment as a picture and as an animation.
 */
#ifndef vpApp_runPicture_h
#define vpApp_runPicture_h

#include "armPicture.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

namespace vpApp
{
//! When the tool has gone so much of its way, 0..1.
[[nodiscard]] const vpAvoidanceSample &sampleAt(const vpAvoidanceRun &run, double share);
//! The obstacle where it is then, s.
[[nodiscard]] vpCollisionObject objectAt(const vpMovingObstacle &obstacle, double time);
//! The way of the tool, thinned out.
[[nodiscard]] ArmTrace toolTrace(const vpAvoidanceRun &run, const std::string &label, const std::string &colour);

/*!
 * The arm at the start (grey), at the end (dark) and in between (faint), start and goal, and the obstacles where they are
 * when the tool is half way. Traces are left to the caller.
 */
[[nodiscard]] ArmPicture runPicture(const vpAvoidanceRun &run, const std::string &title);
//! The first 20 s, 20 pictures a second; captions say the status. Traces are left to the caller.
[[nodiscard]] ArmAnimation runAnimation(const vpAvoidanceRun &run, const std::string &title);
} // namespace vpApp

#endif
