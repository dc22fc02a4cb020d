/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// An object in the fast path: a core with a known distance from a segment, and a radius around it.
#ifndef vpCollisionCore_h
#define vpCollisionCore_h

#include "vpSegmentNearest.h"

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

struct vpCollisionCore {
  vpShapeType type = vpShapeType::Sphere;
  vpRigidTransform pose;
  double radius = 0.; // Radius of a sphere or capsule, plus the inflation.
  Eigen::Vector3d half =
      Eigen::Vector3d::Zero(); // Box: half its size. Cylinder: radius, -, half its length. Capsule: z.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(); // Centre of the core's bounding sphere, in the object's frame.
  double bound = 0.;                                // Radius of the bounding sphere.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); // Centre of the bounding sphere, in the base.
  const vpTriangleMeshData *mesh = nullptr;         // Kept alive by the object's shape.
  const vpOctreeData *octree = nullptr;

  vpCollisionCore() = default;
  explicit vpCollisionCore(const vpCollisionObject &object);

  void move(const vpRigidTransform &to) noexcept
  {
    pose = to;
    centre = to.R * middle + to.p;
  }
  // Largest distance of a point from the origin of the object's frame.
  [[nodiscard]] double reach() const noexcept { return middle.norm() + bound + radius; }
  // Neither mesh nor octree: the plane through the nearest point, perpendicular to the normal, separates.
  [[nodiscard]] bool isConvex() const noexcept { return !mesh && !octree; }
  // Ends of a capsule's core; for a sphere both are its centre.
  [[nodiscard]] Eigen::Vector3d end(double sign) const noexcept { return pose.p + sign * half.z() * pose.R.col(2); }

  /*
   * Nearest points of the core and of a segment in the base. A mesh or octree beyond the cutoff gives an
   * infinite distance without points. Negative inside a watertight mesh.
   */
  [[nodiscard]] vpNearestPoints nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                        double cutoff) const noexcept;
  // Clearance of a capsule of the arm; may be negative (see nearest()). Beyond the cutoff without points.
  [[nodiscard]] vpClearance clearance(const vpPlacedCapsule &c, double cutoff) const noexcept;
};

// Clearance of two capsules of the arm. Beyond the cutoff without points.
vpClearance vpSelfClearance(const vpPlacedCapsule &a, const vpPlacedCapsule &b, double cutoff) noexcept;
// Clearance of a capsule of the arm from the ground.
vpClearance vpGroundClearance(const vpHalfSpace &ground, const vpPlacedCapsule &c) noexcept;

END_VISP_NAMESPACE
#endif
