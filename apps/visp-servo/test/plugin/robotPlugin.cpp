/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Robots as a user's library gives them: a simulated arm by the clock, none, or an exception.
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/servoing/vpRobotPlugin.h>
#include <visp3/simulation/vpSimulatedArm.h>

#include <string>

VISP_DIRECT_USING_NAMESPACE

extern "C" VISP_EXPORT vpRobot *vispDirectRobot(const char *arguments)
{
  if (KIND == 1) {
    return nullptr;
  }
  if (KIND == 2) {
    throw vpException(vpException::fatalError, "no robot answers at %s", arguments);
  }
  vpSimulatedArmSpec spec;
  spec.clock = vpArmClock::RealTime;
  return new vpSimulatedArm(vpLoadArmJson(arguments), spec);
}
