/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file session.h
 * \brief What the program does, from the options to the exit status.
 */
#ifndef visualServo_session_h
#define visualServo_session_h

#include "camera.h"
#include "liveRobot.h"
#include "options.h"

#include <string>

namespace visualServo
{
//! The controller of the first law, with the view of the camera, whose place \e options get, too. \throw vpException naming a law
//! that is not known.
[[nodiscard]] vpServoController controllerOf(Options &options, const Eye &eye);
//! Moves the robot and writes the result. \return Exit status. \throw std::exception with a sentence.
[[nodiscard]] int servo(const Options &options, const std::string &commandLine);
//! Writes the goal file and the mean image from where the camera stands. \return Exit status. \throw As servo().
[[nodiscard]] int teach(const Options &options);
//! Sees and steers a recording once more. \return Exit status. \throw As servo().
[[nodiscard]] int replay(const Options &options, const std::string &commandLine);
} // namespace visualServo

#endif
