/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoStart.h
 * \brief Start configuration of an arm for a servo task with all poses reachable.
 */
#ifndef vpServoStart_h
#define vpServoStart_h

#include <visp3/manipulator/vpArmModel.h>
#include "lab/servo/vpServoTask.h"

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Rates a start for a task: the minimum along the path through all poses (vpClosedLoopKinematics) of the
 * distance from the position limits, as a fraction of half the range, and of the smallest singular value in 0.2 m/rad.
 * \param model : The arm. \param task : The poses. \param start : Configuration at the start, rad or m.
 * \param free : Axes of the camera that need not agree.
 * \return 0..1; negative if a pose is unreachable.
 */
[[nodiscard]] double rateServoStart(const vpArmModel &model, const vpServoTask &task, const vpJointVector &start,
                                    const std::array<bool, 6> &free = {});

/*!
 * \brief The arm's home if its file gives one; else the best of 200 random configurations (always the same) by
 * rateServoStart().
 * \throw vpException (badValue) naming arm and task if none reaches all poses.
 */
[[nodiscard]] vpJointVector findServoStart(const vpArmModel &model, const vpServoTask &task,
                                           const std::array<bool, 6> &free = {});

END_VISP_NAMESPACE
#endif
