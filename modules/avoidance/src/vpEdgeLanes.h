/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// An interval of a straight motion at eight configurations: which pairs are proven free around each of them.
#ifndef vpEdgeLanes_h
#define vpEdgeLanes_h

#include "vpObjectTree.h"

#include <visp3/avoidance/vpCollisionScene.h>

#include <array>
#include <cstdint>

BEGIN_VISP_NAMESPACE

//! A capsule of the arm, or the bounding capsule of a link, in the moving frame of its joint.
struct vpEdgeCapsule {
  int link = 0;
  Eigen::Vector3d from, to;
  double radius = 0.;
  double halfLength = 0.; // Of the axis.
};

//! A pair that must not touch.
struct vpEdgePair {
  vpCollisionKind kind = vpCollisionKind::None;
  int capsule = 0;   // Index into vpEdgeMotion::capsules. The capsule that moves more: of two the outer one.
  int other = 0;     // The object, or the inner capsule.
  int innerLink = 0; // Two capsules: link of the inner one.
  int exact = -1;    // Exact pair that decides where the capsules touch; -1: none.
  // Bounding capsules stand for the pairs begin..end - 1, which are evaluated where these are not proven.
  std::uint32_t begin = 0, end = 0;
};

//! Bounds of a link for the whole motion, seen from another one.
struct vpEdgeBound {
  double speed = 0.;        // sum R |dq|: largest motion per unit of s, m.
  double acceleration = 0.; // sum sum |dq_j| |dq_k| R: largest velocity change per unit of s, m.
};

//! Pairs of bounding capsules and objects.
struct vpEdgeObjects {
  static constexpr std::uint32_t unchecked = 0xffffffff;
  const std::vector<vpObjectNode> *tree = nullptr;
  const std::uint32_t *pairs = nullptr; // By object and hull: the pair, or unchecked.
  int firstHull = 0, hulls = 0;         // Capsules of the hulls.
};

struct vpEdgeMotion {
  const vpArmModel *arm = nullptr;
  const vpHalfSpace *ground = nullptr;
  const vpEdgeCapsule *capsules = nullptr;
  const vpCollisionCore *cores = nullptr; // Of the objects.
  double margin = 0.;
  vpJointVector from, change; // Of all of the chain, followers included.
  // Of a link, seen from a link nearer to the base (0: the base).
  std::array<std::array<vpEdgeBound, vpArmMaxJoints + 1>, vpArmMaxJoints + 1> bounds;
};

//! Largest number of capsules with the bounding ones.
constexpr int vpEdgeMostCapsules = vpArmMaxCapsules + vpArmMaxJoints + 1;

struct vpEdgeBatch {
  const vpEdgeObjects *objects = nullptr; // If given, their pairs are evaluated too, except those that are far apart.
  double slack[8];                  // Least of clearance - need over the pairs evaluated, m: small where it is tight.
  int hitPair = -1;                 // A colliding pair without exact shapes, -1: none.
  int hitLane = 0;                  // Its lane.
  std::uint32_t *open = nullptr;    // Room for all pairs: those not proven free, in the order of their evaluation.
  int count = 0;                    // Their number.
  std::uint8_t *unproven = nullptr; // By pair, 0 before: bit l is set if it is not proven free around lane l.
  std::uint8_t *touched = nullptr;  // By pair: bit l is set if its capsules touch at lane l.
};

/*
 * Evaluates s = start + (l + 1/2) width / 8, l = 0..7, each for the interval of width / 8 around it. Stops at the first
 * colliding pair without exact shapes.
 */
void vpEvaluateEdge(const vpEdgeMotion &motion, const vpEdgePair *pairs, const std::uint32_t *list, int count,
                    double start, double width, vpEdgeBatch &batch) noexcept;

END_VISP_NAMESPACE
#endif
