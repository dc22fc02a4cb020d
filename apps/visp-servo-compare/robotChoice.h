/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file robotChoice.h
 * \brief Which robot carries the camera.
 */
#ifndef servoCompare_robotChoice_h
#define servoCompare_robotChoice_h

#include "options.h"

#include "lab/servo/vpServoArm.h"
#include "lab/servo/vpServoTask.h"

#include <memory>
#include <string>

VISP_DIRECT_USING_NAMESPACE

namespace servoCompare
{
/*!
 * The arm that was asked for, with a start from which the task can be done and its self-motion; nothing for a camera
 * that flies freely.
 * \throw vpApp::UsageError for an unknown choice; vpException naming the file and the element that does not do.
 */
[[nodiscard]] std::shared_ptr<const vpServoArm> chooseArm(const RobotOptions &options, const vpServoTask &task);

//! The arm in a sentence: joints, start, what the spare joints do.
[[nodiscard]] std::string sentenceOf(const vpServoArm &arm);
} // namespace servoCompare

#endif
