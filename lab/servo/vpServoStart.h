/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoStart.h
 * \brief Where an arm begins a servo task, so that all of its poses are within reach.
 */
#ifndef vpServoStart_h
#define vpServoStart_h

#include <visp3/manipulator/vpArmModel.h>
#include "lab/servo/vpServoTask.h"

BEGIN_VISP_NAMESPACE

/*!
 * \brief How well a start suits a task: the least over the way through all poses (vpClosedLoopKinematics) of the distance
 * from the position limits, as a part of half the range, and of the smallest singular value in 0.2 m/rad.
 * \return 0..1; negative when a pose cannot be reached.
 */
[[nodiscard]] double rateServoStart(const vpArmModel &model, const vpServoTask &task, const vpJointVector &start);

/*!
 * \brief The arm's home where its file gives one; else the best of 200 random configurations (always the same ones) by
 * rateServoStart().
 * \throw vpException (badValue) naming arm and task when none of them reaches all poses.
 */
[[nodiscard]] vpJointVector findServoStart(const vpArmModel &model, const vpServoTask &task);

END_VISP_NAMESPACE
#endif
