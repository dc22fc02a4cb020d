/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// An interval of a straight motion at eight configurations: which pairs are proven free around each of them.
#ifndef vpEdgeLanes_h
#define vpEdgeLanes_h

#include "vpCollisionCore.h"

#include <visp3/avoidance/vpCollisionScene.h>

#include <cstdint>

BEGIN_VISP_NAMESPACE

//! A pair that must not touch, with bounds valid for the whole motion.
struct vpEdgePair {
  vpCollisionKind kind = vpCollisionKind::None;
  int capsule = 0;                       // The capsule that moves more: of a pair the outer one.
  int other = 0;                         // The object, or the inner capsule.
  int innerLink = 0;                     // Two capsules: link of the inner one.
  double radii = 0.;                     // Sum of both radii and the margin, m.
  double bounds = 0.;                    // Sum of both bounding spheres of the cores and the margin, m.
  const vpCollisionCore *core = nullptr; // Core of the object.
  double speed = 0.;                     // sum R |dq|: largest capsule motion per unit of s, m.
  double acceleration = 0.;              // sum sum |dq_j| |dq_k| R: largest velocity change per unit of s, m.
};

struct vpEdgeMotion {
  const vpCollisionScene *scene = nullptr;
  const vpHalfSpace *ground = nullptr;
  vpJointVector from, change;
};

struct vpEdgeBatch {
  double slack[8];  // Least of clearance - need over the pairs evaluated, m: small where it is tight.
  int hitPair = -1; // List position of a colliding pair, -1: none.
  int hitLane = 0;  // Its lane.
};

/*
 * Evaluates s = start + (l + 1/2) width / 8, l = 0..7. Bit l of unproven[k] is set if pair list[k] is not proven free
 * for the interval of width / 8 around it. Stops at the first colliding pair.
 */
void vpEvaluateEdge(const vpEdgeMotion &motion, const vpEdgePair *pairs, const std::uint32_t *list, int count,
                    double start, double width, std::uint8_t *unproven, vpEdgeBatch &batch) noexcept;

END_VISP_NAMESPACE
#endif
