/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRobotPlugin.h
 * \brief The function by which a shared library gives its robot to visp-servo.
 */
#ifndef vpRobotPlugin_h
#define vpRobotPlugin_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE
class vpRobot;

/*!
 * \ingroup group_servoing
 * Written by you, in a shared library: makes a robot for `visp-servo --robot-plugin LIBRARY --robot-arguments TEXT`.
 * \code
 * #include <visp3/robot/vpSimulatorCamera.h>
 * #include <visp3/servoing/vpRobotPlugin.h>
 * extern "C" VISP_EXPORT vpRobot *vispDirectRobot(const char *address)
 * {
 *   auto robot = std::make_unique<vpSimulatorCamera>(); // or a class of your own, derived from vpRobot
 *   robot->setSamplingTime(std::stod(address));         // may throw: visp-servo prints the message and ends
 *   return robot.release();
 * }
 * \endcode
 * Build it with the same ViSP and compiler as visp-servo: `g++ -shared -fPIC my-robot.cpp -o libmy-robot.so`. The program calls
 * from one thread, every period:
 * - `setRobotState(STATE_VELOCITY_CONTROL)`, once, before the first motion, and `setRobotState(STATE_STOP)` at the end,
 *   and after a failure;
 * - `setVelocity()`: with a model of the arm (`--robot FILE`) JOINT_STATE, rad/s or m/s in the order of the model; else
 *   with `--eMc` or `--eye-to-hand` END_EFFECTOR_FRAME, else CAMERA_FRAME: m/s and rad/s in that frame's axes, linear
 *   part first;
 * - `getPosition()`: with a model JOINT_STATE, rad or m; else the frame of setVelocity(): its pose in the robot's base
 *   as (m, theta u). A robot that throws at the first call with that frame has no pose: its commanded motion counts as
 *   executed.
 *
 * Neither may block for longer than the period. An exception stops the robot and ends the run with its sentence.
 * \param arguments : Text of `--robot-arguments`, such as an address; empty if it is not given.
 * \return The robot, which the program deletes; null: the program ends.
 */
extern "C" vpRobot *vispDirectRobot(const char *arguments);

END_VISP_NAMESPACE
#endif
