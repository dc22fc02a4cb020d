/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "robotPlugin.h"

#include "appMain.h"

#include <visp3/core/vpConfig.h>
#include <visp3/robot/vpRobotAfma6.h>
#include <visp3/robot/vpRobotFranka.h>
#include <visp3/robot/vpRobotViper650.h>
#include <visp3/robot/vpRobotViper850.h>
#if __has_include(<visp3/robot/vpRobotUniversalRobots.h>)
#include <visp3/robot/vpRobotUniversalRobots.h>
#endif

#include <algorithm>
#include <stdexcept>

// Each function is empty where the installed ViSP was built without the robot's driver: its header then declares nothing.
namespace visualServo
{
namespace
{
using Mount = std::optional<vpHomogeneousMatrix>;
using Maker = OpenedRobot (*)(const std::string &address, const Mount &eMc);

template <class Driver, class Tool> OpenedRobot openWithTool(Tool tool, const Mount &eMc)
{
  auto robot = std::make_shared<Driver>();
  if (eMc) {
    robot->init(tool, *eMc);
  }
  return {robot, "", PoseOf::Reference, true};
}

template <class Driver> OpenedRobot openByAddress(const std::string &address, const Mount &eMc)
{
  auto robot = std::make_shared<Driver>();
  robot->connect(address);
  robot->set_eMc(eMc.value_or(vpHomogeneousMatrix()));
  return {robot, "", PoseOf::Camera, true};
}

#if defined(VISP_HAVE_FRANKA)
constexpr Maker openFranka = openByAddress<vpRobotFranka>;
#else
constexpr Maker openFranka = nullptr;
#endif
#if defined(VISP_HAVE_UR_RTDE)
constexpr Maker openUr = openByAddress<vpRobotUniversalRobots>;
#else
constexpr Maker openUr = nullptr;
#endif
#if defined(VISP_HAVE_VIPER650)
constexpr Maker openViper650 = [](const std::string &, const Mount &eMc) {
  return openWithTool<vpRobotViper650>(vpViper650::TOOL_CUSTOM, eMc);
};
#else
constexpr Maker openViper650 = nullptr;
#endif
#if defined(VISP_HAVE_VIPER850)
constexpr Maker openViper850 = [](const std::string &, const Mount &eMc) {
  return openWithTool<vpRobotViper850>(vpViper850::TOOL_CUSTOM, eMc);
};
#else
constexpr Maker openViper850 = nullptr;
#endif
#if defined(VISP_HAVE_AFMA6)
constexpr Maker openAfma6 = [](const std::string &, const Mount &eMc) {
  return openWithTool<vpRobotAfma6>(vpAfma6::TOOL_CUSTOM, eMc);
};
#else
constexpr Maker openAfma6 = nullptr;
#endif

struct Entry {
  const char *word, *className;
  Maker open;
};
constexpr Entry ENTRIES[] = {{"franka", "vpRobotFranka", openFranka},
                             {"ur", "vpRobotUniversalRobots", openUr},
                             {"viper650", "vpRobotViper650", openViper650},
                             {"viper850", "vpRobotViper850", openViper850},
                             {"afma6", "vpRobotAfma6", openAfma6}};
} // namespace

const std::vector<VispRobot> &robotsOfVisp()
{
  static const std::vector<VispRobot> all = [] {
    std::vector<VispRobot> robots;
    for (const Entry &entry : ENTRIES) {
      robots.push_back({entry.word, entry.className, entry.open != nullptr});
    }
    return robots;
  }();
  return all;
}

void requireVispRobot(const std::string &word)
{
  const auto &all = robotsOfVisp();
  const auto robot = std::find_if(all.begin(), all.end(), [&word](const VispRobot &one) { return word == one.word; });
  if (robot == all.end()) {
    throw vpApp::UsageError("--robot is " + word + ", which is no file and no robot of ViSP; --list names these");
  }
  if (!robot->isBuilt) {
    throw std::runtime_error("--robot " + word + ": the installed ViSP was built without " + robot->className);
  }
}

OpenedRobot openVispRobot(const Options &options)
{
  const std::string &word = options.motion.robot.robot;
  requireVispRobot(word);
  const auto *entry =
      std::find_if(std::begin(ENTRIES), std::end(ENTRIES), [&word](const Entry &one) { return word == one.word; });
  OpenedRobot opened = entry->open(options.motion.arguments, mountOf(options));
  opened.name = std::string("the robot ") + entry->className;
  return opened;
}
} // namespace visualServo
