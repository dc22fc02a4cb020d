/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// One step of a servo law, and a word of planar_target, from outside the source tree.
#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/planar_target/vpPlanarTarget.h>

#include <iostream>

VISP_DIRECT_USING_NAMESPACE

int main()
{
  vpServoGoal goal;
  goal.cdMo.buildFrom(0., 0., 0.5, 0., 0., 0.);
  goal.points = {{-0.1, -0.1, 0.5}, {0.1, -0.1, 0.5}, {0.1, 0.1, 0.5}, {-0.1, 0.1, 0.5}};

  vpServoMeasurement seen;
  seen.valid = true;
  seen.cMo.buildFrom(0.02, 0., 0.6, 0., 0., 0.);
  for (const vpServoPoint &point : goal.points) {
    seen.points.push_back({(point.x * point.Z + 0.02) / 0.6, point.y * point.Z / 0.6, 0.6});
  }

  auto law = vpServoLaw::create("ff-lookat");
  law->setGoal(goal);
  const vpServoCommand command = law->step(seen, 0.01);
  std::cout << law->id() << ": " << vpToString(command.status);
  for (std::size_t i = 0; i < 6; ++i) {
    std::cout << ' ' << command.v[i];
  }
  std::cout << ", keypoints " << vpToString(vpKeypointType::ORB) << std::endl;
  // The object is too far and too far right: the camera must go forward and right.
  return command.v[0] > 0. && command.v[2] > 0. ? 0 : 1;
}
