/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A piece of a straight motion at eight configurations: which pairs are proven free about each of them.
#ifndef vpEdgeLanes_h
#define vpEdgeLanes_h

#include "vpCollisionCore.h"

#include <visp3/avoidance/vpCollisionScene.h>

#include <cstdint>

BEGIN_VISP_NAMESPACE

//! A pair that must not touch, with bounds that hold for the whole motion.
struct vpEdgePair {
  vpCollisionKind kind = vpCollisionKind::None;
  int capsule = 0;                       // The one that moves more: of a pair of capsules the outer one.
  int other = 0;                         // Object, or the inner capsule.
  int innerLink = 0;                     // Of two capsules: the link of the inner one.
  double radii = 0.;                     // Of both and the margin, m.
  double bounds = 0.;                    // The same with the spheres around both cores, m.
  const vpCollisionCore *core = nullptr; // Of the object.
  double speed = 0.;                     // sum R |dq|: most that the capsule moves per unit of s, m.
  double acceleration = 0.;              // sum sum |dq_j| |dq_k| R: most that its velocity changes per unit of s, m.
};

struct vpEdgeMotion {
  const vpCollisionScene *scene = nullptr;
  const vpHalfSpace *ground = nullptr;
  vpJointVector from, change;
};

struct vpEdgeBatch {
  double slack[8];  // Least of clearance - need over the pairs looked at, m: small where it is tight.
  int hitPair = -1; // Position in the list of a pair that collides, -1: none.
  int hitLane = 0;  // Where.
};

/*
 * Looks at s = start + (l + 1/2) width / 8, l = 0..7. Bit l of unproven[k] is set when pair list[k] is not proven free
 * for the interval of width / 8 about it. Stops at the first pair that collides.
 */
void vpEvaluateEdge(const vpEdgeMotion &motion, const vpEdgePair *pairs, const std::uint32_t *list, int count,
                    double start, double width, std::uint8_t *unproven, vpEdgeBatch &batch) noexcept;

END_VISP_NAMESPACE
#endif
