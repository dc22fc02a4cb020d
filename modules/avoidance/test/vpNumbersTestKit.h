/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A scene of every shape, for numbers out of range.
#ifndef vpNumbersTestKit_h
#define vpNumbersTestKit_h

#include "vpAvoidanceTestKit.h"
#include "vpWildNumbers.h"

namespace vpAvoidanceTestKit
{
inline vpJointVector home() { return amor().home(); }

inline bool isInRange(const vpJointVector &q) { return (q.cwiseAbs().array() <= vpLargestCoordinate).all(); }

//! Something of every shape, out of the way of AMOR at home.
inline vpCollisionSceneSpec everything()
{
  vpCollisionSceneSpec spec;
  const auto add = [&spec](const char *name, const vpCollisionShape &shape, const Vector3d &place) {
    vpCollisionObject object;
    object.name = name;
    object.shape = shape;
    object.pose.p = place;
    object.velocity = vpTwist(0.01, 0., 0., 0., 0.1, 0.);
    spec.objects.push_back(object);
  };
  add("sphere", vpCollisionShape::sphere(0.1), {-1.5, 0., 0.});
  add("capsule", vpCollisionShape::capsule(0.1, 0.2), {0., -1.5, 0.});
  add("box", vpCollisionShape::box({0.2, 0.3, 0.1}), {1.5, 0., 0.});
  add("cylinder", vpCollisionShape::cylinder(0.1, 0.2), {1.5, 1., 0.});
  add("mesh", vpCollisionShape::mesh(tetrahedron(0.1)), {-1.5, 1., 0.5});
  add("octree", vpCollisionShape::octree(vpOctree({{{0., 0., 0.}, 0.1}, {{0.1, 0., 0.}, 0.1}})), {0., 1.8, 0.});
  vpHalfSpace ground;
  ground.offset = -0.5;
  spec.ground = ground;
  return spec;
}
} // namespace vpAvoidanceTestKit
#endif
