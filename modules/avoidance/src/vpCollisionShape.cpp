/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCollisionObject.h>
#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
double checked(const char *what, double value, bool zeroAllowed = false)
{
  if (!(value <= vpLargestLength) || !(zeroAllowed ? value >= 0. : value > 0.)) {
    throw vpException(vpException::badValue, "%s is %g m, must be %s 0 and at most %g m", what, value,
                      zeroAllowed ? ">=" : ">", vpLargestLength);
  }
  return value;
}
} // namespace

vpCollisionShape vpCollisionShape::sphere(double radius)
{
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Sphere;
  shape.m_radius = checked("radius of the sphere", radius);
  return shape;
}

vpCollisionShape vpCollisionShape::capsule(double radius, double length)
{
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Capsule;
  shape.m_radius = checked("radius of the capsule", radius);
  shape.m_length = checked("length of the capsule", length, true);
  return shape;
}

vpCollisionShape vpCollisionShape::box(const Eigen::Vector3d &size)
{
  static const char *const names[] = {"size of the box along x", "size of the box along y", "size of the box along z"};
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Box;
  for (int i = 0; i < 3; ++i) {
    shape.m_size(i) = checked(names[i], size(i));
  }
  return shape;
}

vpCollisionShape vpCollisionShape::cylinder(double radius, double length)
{
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Cylinder;
  shape.m_radius = checked("radius of the cylinder", radius);
  shape.m_length = checked("length of the cylinder", length);
  return shape;
}

vpCollisionShape vpCollisionShape::mesh(const vpTriangleMesh &mesh, vpMeshUse use)
{
  if (use == vpMeshUse::Solid && !mesh.isWatertight()) {
    throw vpException(
        vpException::badValue,
        "%s; close it, or say that a surface is enough (\"surface\": true in a scene, vpMeshUse::Surface)",
        mesh.message().c_str());
  }
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Mesh;
  shape.m_mesh = mesh;
  return shape;
}

vpCollisionShape vpCollisionShape::octree(const vpOctree &octree)
{
  vpCollisionShape shape;
  shape.m_type = vpShapeType::Octree;
  shape.m_octree = octree;
  return shape;
}

vpRigidTransform vpCollisionObject::poseAt(double t) const noexcept
{
  if (t == 0.) {
    return pose;
  }
  const Eigen::Vector3d v(velocity[0], velocity[1], velocity[2]), w(velocity[3], velocity[4], velocity[5]);
  return {vpSO3::exp(t * w) * pose.R, pose.p + t * v};
}

END_VISP_NAMESPACE
