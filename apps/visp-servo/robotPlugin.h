/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file robotPlugin.h
 * \brief Robots of ViSP and of plug-ins.
 */
#ifndef visualServo_robotPlugin_h
#define visualServo_robotPlugin_h

#include "liveRobot.h"

#include <visp3/robot/vpRobot.h>

#include <optional>

namespace visualServo
{
//! What getPosition() of a robot gives.
enum class PoseOf {
  Nothing, //!< No pose: the commanded motion counts as executed.
  Camera,  //!< CAMERA_FRAME: pose of the camera in the base, (m, theta u); END_EFFECTOR_FRAME that of the end effector.
  Reference //!< REFERENCE_FRAME: pose of the camera in the base, (m, Rxyz), as the Viper and Afma robots.
};

//! \brief A robot, connected.
struct OpenedRobot {
  std::shared_ptr<vpRobot> robot;
  std::string name;
  PoseOf pose = PoseOf::Camera;
  bool hasMount = false; //!< It knows eMc.
};

/*!
 * Camera in the end effector; none: as the robot has it. Before a fixed camera the end effector itself takes the camera's place.
 * \throw vpException as vpLoadPose().
 */
[[nodiscard]] std::optional<vpHomogeneousMatrix> mountOf(const Options &options);
/*!
 * The robot of ViSP that the options name.
 * \throw vpApp::UsageError for an unknown word; std::runtime_error if ViSP was built without it.
 */
[[nodiscard]] OpenedRobot openVispRobot(const Options &options);
/*!
 * A robot of a library, see visp3/servoing/vpRobotPlugin.h. \param frame : Of its pose; where it gives none, OpenedRobot::pose is
 * Nothing.
 * \throw std::runtime_error naming the library and what is wrong.
 */
[[nodiscard]] OpenedRobot openPlugin(const std::string &library, const std::string &arguments,
                                     vpRobot::vpControlFrameType frame);
} // namespace visualServo

#endif
