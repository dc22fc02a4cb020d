/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-servo: servo a simulated or real robot by its camera.
#include "session.h"

#include "appMain.h"

#include <visp3/feedforward/vpServoLaw.h>

#include <iostream>

namespace
{
using namespace visualServo;

int list()
{
  std::cout << "Laws (each but those that plan also with +cbf, which keeps the target in view):\n";
  for (const std::string &id : vpServoLaw::ids()) {
    std::cout << "  " << id << ": " << vpServoLaw::sentence(id) << "\n";
  }
  std::cout << "Robots of ViSP:\n";
  for (const VispRobot &robot : robotsOfVisp()) {
    std::cout << "  " << robot.word << ": " << robot.className
              << (robot.isBuilt ? "" : " (the installed ViSP was built without it)") << "\n";
  }
  std::cout << "Any other vpRobot: --robot-plugin, see visp3/servoing/vpRobotPlugin.h" << std::endl;
  return vpApp::ExitOk;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runMain("visp-servo", [&]() -> int {
    Options options;
    if (!readOptions(argc, argv, options)) {
      return vpApp::ExitOk;
    }
    const std::string commandLine = vpApp::commandLine("visp-servo", argc, argv);
    switch (options.task) {
    case Task::List:
      return list();
    case Task::Teach:
      return teach(options);
    case Task::Replay:
      return replay(options, commandLine);
    case Task::Servo:
      break;
    }
    return servo(options, commandLine);
  });
}
