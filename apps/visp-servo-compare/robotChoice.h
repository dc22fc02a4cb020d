/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file robotChoice.h
 * \brief The robot that carries the camera.
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
 * The requested arm, with a start configuration from which the task is feasible and its self-motion; null for a
 * free-flying camera.
 * \throw vpApp::UsageError for an unknown choice; vpException naming the file and the invalid element.
 */
[[nodiscard]] std::shared_ptr<const vpServoArm> chooseArm(const RobotOptions &options, const vpServoTask &task);

//! The arm in a sentence: joints, start, self-motion.
[[nodiscard]] std::string sentenceOf(const vpServoArm &arm);
} // namespace servoCompare

#endif
