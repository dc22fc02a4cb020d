/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "robotPlugin.h"

#include "appMain.h"
#include "plugin.h"

#include <visp3/servoing/vpRobotPlugin.h>

#include <stdexcept>

namespace visualServo
{
OpenedRobot openPlugin(const std::string &library, const std::string &arguments, vpRobot::vpControlFrameType frame)
{
  const auto make = reinterpret_cast<decltype(&vispDirectRobot)>(
      vpApp::pluginFunction(library, "vispDirectRobot", "visp3/servoing/vpRobotPlugin.h"));
  OpenedRobot opened;
  try {
    opened.robot.reset(make(arguments.c_str()));
  }
  catch (const std::exception &error) {
    throw std::runtime_error(library + ": " + vpApp::sentenceOf(error));
  }
  if (!opened.robot) {
    throw std::runtime_error(library + ": vispDirectRobot(\"" + arguments + "\") gave no robot");
  }
  opened.name = "the robot of " + library;
  try {
    vpColVector p;
    opened.robot->getPosition(frame, p);
    opened.pose = p.size() == 6 ? PoseOf::Camera : PoseOf::Nothing;
  }
  catch (const std::exception &) {
    opened.pose = PoseOf::Nothing;
  }
  return opened;
}
} // namespace visualServo
