/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A solid as triangles and a radius around them.
#ifndef vpTriangleSolid_h
#define vpTriangleSolid_h

#include <visp3/avoidance/vpCollisionShape.h>
#include <visp3/manipulator/vpArmSpec.h>

#include <Eigen/Geometry>

BEGIN_VISP_NAMESPACE

struct vpTriangleSolid {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  double radius = 0.;                 // Around the triangles, m: of a sphere.
  std::vector<Eigen::Vector3d> parts; // A point of each part that is connected by vertices.
  Eigen::AlignedBox3d box;

  //! A shape of the arm, in its link's frame. \throw vpException (badValue, ioError) naming the file.
  [[nodiscard]] static vpTriangleSolid of(const vpArmShape &shape);
  //! The shape of an object; without the radius of spheres and capsules.
  [[nodiscard]] static vpTriangleSolid of(const vpCollisionShape &shape);
  //! Points whose convex hull is the shape of the arm: vertices, or of a cylinder points of its two rims.
  [[nodiscard]] static std::vector<Eigen::Vector3d> pointsOn(const vpArmShape &shape, const vpTriangleSolid &solid);

  //! Into the frame in which T is the pose of this one.
  void move(const vpRigidTransform &T);
  //! True if the winding number about p exceeds 1/2, whatever the orientation.
  [[nodiscard]] bool contains(const Eigen::Vector3d &p) const noexcept;

private:
  void addBox(const Eigen::Vector3d &centre, const Eigen::Vector3d &half);
  void addPrism(double inner, double half);
  void addThread(const Eigen::Vector3d &from, const Eigen::Vector3d &to);
  void finish();
};

END_VISP_NAMESPACE
#endif
