/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Distances of exact shapes; one object per thread.
#ifndef vpExactQuery_h
#define vpExactQuery_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/avoidance/vpExactShapes.h>

BEGIN_VISP_NAMESPACE

//! Two parts of which at least one pair of capsules must not touch, and that both have exact shapes.
struct vpExactPair {
  vpCollisionKind kind = vpCollisionKind::None;
  int body = -1;    // The outer one of two bodies.
  int other = -1;   // The object, or the inner body.
  int capsule = -1; // Capsules for messages: of the body,
  int inner = -1;   // and of the inner one.
};

/*
 * Distances of the arm's exact shapes, in the configuration of a vpCollisionData, from objects, the ground and each
 * other. Triangles of objects are made when they are needed first, and kept as long as the scene has the same objects.
 */
class vpExactQuery
{
public:
  vpExactQuery();
  ~vpExactQuery();
  vpExactQuery(const vpExactQuery &) = delete;
  vpExactQuery &operator=(const vpExactQuery &) = delete;

  /*
   * Clearance of the pair if it is less than cutoff, else an infinite one; 0 if the parts touch.
   * inside: also look whether one part is inside the other, without touching it: a motion without contact keeps that.
   */
  [[nodiscard]] vpClearance clearance(const vpCollisionScene &scene, const vpCollisionData &data,
                                      const vpExactPair &pair, double cutoff, bool inside);

  //! The exact pair of two capsules, an object (other), or the ground; kind None unless both parts have exact shapes.
  [[nodiscard]] static vpExactPair pairOf(const vpCollisionScene &scene, vpCollisionKind kind, int capsule, int other);

private:
  struct Objects;
  std::unique_ptr<Objects> m_objects;
};

END_VISP_NAMESPACE
#endif
