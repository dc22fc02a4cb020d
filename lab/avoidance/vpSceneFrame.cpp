/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpSceneFrame.h"

#include "lab/avoidance/vpSceneDraw.h"

#include <visp3/manipulator/vpArmKinematics.h>

#include <Eigen/Geometry>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr unsigned int reachNumber = 0, touchNumber = 8; // of the random streams; scenes have 1 to 7
constexpr double amorReach = 1.1;                        // m
constexpr double alike[] = {0.6, 1.4};                   // m, reach of arms for which scenes are not scaled

//! Frame of the first revolute joint at home; the base of an arm without any.
vpRigidTransform firstRevolute(const vpArmModel &arm)
{
  vpArmData data;
  vpArmKinematics::forward(arm, arm.home(), data);
  for (int i = 0; i < arm.links(); ++i) {
    if (!arm.chain(i).isPrismatic) {
      return data.joint[static_cast<std::size_t>(i)];
    }
  }
  return {};
}
} // namespace

vpSceneFrame vpSceneFrame::of(const vpArmModel &arm)
{
  constexpr int configurations = 4096;
  vpSceneFrame frame;
  const vpRigidTransform first = firstRevolute(arm);
  const Eigen::Vector3d axis = first.R.col(2);
  frame.centre = first.p;
  frame.reach = 0.;
  for (int i = 0; i < configurations; ++i) {
    vpHashRandom random = vpSceneDraw::random(reachNumber, 1, i);
    const Eigen::Vector3d tool = vpSceneDraw::tool(arm, vpSceneDraw::configuration(arm, random));
    frame.reach = std::max(frame.reach, (tool - frame.centre).cross(axis).norm());
  }
  frame.scale = frame.reach >= alike[0] && frame.reach <= alike[1] ? 1. : frame.reach / amorReach;
  frame.firstLink = std::min(3, arm.size());
  constexpr double below = 0.35; // m, height of AMOR's second joint
  frame.ground = frame.centre.z() < 0. ? frame.centre.z() - below * frame.scale : 0.;
  return frame;
}

vpHalfSpace vpSceneFrame::floor() const
{
  vpHalfSpace plane;
  plane.offset = ground;
  plane.firstLink = firstLink;
  return plane;
}

vpCollisionSceneSpec vpIgnoreUncovered(const vpArmModel &arm, vpCollisionSceneSpec spec)
{
  std::vector<std::string> &ignored = spec.ignoredBodies;
  for (const std::string &body : arm.spec().uncovered) {
    if (std::find(ignored.begin(), ignored.end(), body) == ignored.end()) {
      ignored.push_back(body);
    }
  }
  return spec;
}

double vpSelfTouchShare(const vpCollisionScene &scene, int configurations)
{
  int touching = 0;
  vpCollisionData data;
  for (int i = 0; i < configurations; ++i) {
    vpHashRandom random = vpSceneDraw::random(touchNumber, 1, i);
    scene.place(vpSceneDraw::configuration(scene.arm(), random), data);
    touching += std::any_of(scene.selfPairs().begin(), scene.selfPairs().end(), [&](const vpSelfPair &pair) {
      return !(scene.selfPair(data, pair.first, pair.second).distance > 0.);
    });
  }
  return static_cast<double>(touching) / configurations;
}

END_VISP_NAMESPACE
