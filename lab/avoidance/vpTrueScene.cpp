/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpTrueScene.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

vpTrueScene::vpTrueScene(const vpAvoidanceRunSpec &spec) : m_scene(*spec.arm, spec.scene)
{
  for (const vpMovingObstacle &motion : spec.obstacles) {
    m_obstacles.push_back({motion, -1});
    m_fastest = std::max(m_fastest, motion.object.velocity.linearNorm());
  }
}

void vpTrueScene::enter(double t)
{
  for (Obstacle &o : m_obstacles) {
    const bool there = o.motion.isThere(t);
    if (there && o.index < 0) {
      m_scene.add(o.motion.object);
    }
    else if (!there && o.index >= 0) {
      m_scene.remove(m_scene.find(o.motion.object.name));
    }
    o.index = there ? 0 : -1;
  }
  for (Obstacle &o : m_obstacles) { // those after a removed one have moved up
    o.index = o.index >= 0 ? m_scene.find(o.motion.object.name) : -1;
  }
  place(t);
}

bool vpTrueScene::isStill(double t) const noexcept
{
  return std::all_of(m_obstacles.begin(), m_obstacles.end(), [t](const Obstacle &o) {
    const bool gone = t >= o.motion.vanishes;
    return gone ||
           (t >= o.motion.appears && std::isinf(o.motion.vanishes) && o.motion.object.velocity.linearNorm() == 0.);
  });
}

void vpTrueScene::place(double t) noexcept
{
  for (const Obstacle &o : m_obstacles) {
    if (o.index >= 0) {
      vpRigidTransform pose;
      vpTwist velocity;
      o.motion.stateAt(t, pose, velocity);
      static_cast<void>(m_scene.moveObject(o.index, pose));
      static_cast<void>(m_scene.setVelocity(o.index, velocity));
    }
  }
}

END_VISP_NAMESPACE
