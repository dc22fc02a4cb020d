/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Robots of plug-ins as visp-servo moves them: which frame is read, and which is sent.
#include "vpCatch.h"

#include "liveRobot.h"

#include "testFolder.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/direct_core/vpSO3.h>

using namespace visualServo;

TEST_CASE("a robot of a plug-in moves its own camera, that of --eMc, or its end effector by the twist that is sent",
          "[visp-servo][plugin]")
{
  std::mt19937_64 rng = vpTestSupport::generator();
  const auto distance = [](const vpRigidTransform &a, const vpRigidTransform &b) {
    return (a.p - b.p).norm() + (a.R - b.R).norm();
  };
  const TestFolder folder;
  const std::string eMc = folder.write("eMc.txt", "0.1 -0.2 0.3 0.4 0.5 -0.6");
  const vpRigidTransform own{vpSO3::exp({0.5, 0.4, -0.6}), {0.3, 0.2, 0.1}},
      mounted{vpSO3::exp({0.4, 0.5, -0.6}), {0.1, -0.2, 0.3}};
  for (int kind = 0; kind < 3; ++kind) {
    Options options;
    options.motion.robot.robot = "none";
    options.motion.plugin = ROBOT_FRAMES;
    options.motion.eMc = kind == 1 ? eMc : "";
    options.camera.isFixed = kind == 2;
    const std::unique_ptr<Robot> robot = openRobot(options);
    REQUIRE(robot->tellsState());
    vpRigidTransform expected = kind == 0 ? own : kind == 1 ? mounted : vpRigidTransform();
    for (int k = 0; k < 20; ++k) {
      CAPTURE(kind, k);
      CHECK(distance(robot->read().pose, expected) < 1e-9);
      CHECK(distance(robot->pose(), expected) < 1e-9);
      vpVisualServoOutput motion;
      for (std::size_t i = 0; i < 6; ++i) {
        motion.twist[i] = vpTestSupport::uniform(rng, -0.3, 0.3);
      }
      robot->command(motion, 0.005);
      expected = expected * vpRigidTransform::fromHomogeneous(vpExponentialMap::direct(motion.twist.toColVector(), 1.));
    }
  }
}
