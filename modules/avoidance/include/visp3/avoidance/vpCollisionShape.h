/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionShape.h
 * \brief Shape of a body for collision checks.
 */
#ifndef vpCollisionShape_h
#define vpCollisionShape_h

#include <visp3/avoidance/vpOctree.h>
#include <visp3/avoidance/vpTriangleMesh.h>

#include <optional>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Kind of a shape.
enum class vpShapeType {
  Sphere,   //!< Centred on the origin.
  Capsule,  //!< All points within a radius of a segment along z, centred on the origin.
  Box,      //!< Aligned with the frame's axes, centred on the origin.
  Cylinder, //!< Solid, along z, centred on the origin.
  Mesh,     //!< vpTriangleMesh.
  Octree    //!< vpOctree.
};

//! \ingroup group_avoidance
//! \brief Required kind of mesh.
enum class vpMeshUse {
  Solid,  //!< Closed mesh: its inside collides.
  Surface //!< Open meshes allowed, as sheets without inside. A closed one is still a solid.
};

/*!
 * \class vpCollisionShape
 * \ingroup group_avoidance
 * \brief Collision shape (value type) in its own frame; lengths in m. Copies share meshes and octrees.
 *
 * \code
 * vpCollisionObject bracket;
 * bracket.name = "bracket";
 * bracket.shape = vpCollisionShape::mesh(vpTriangleMesh::load("data/scene/bracket.obj", 0.001)); // throws at holes
 * bracket.pose.p << 0.5, 0., 0.2; // m
 * scene.add(bracket);
 * \endcode
 */
class VISP_EXPORT vpCollisionShape
{
public:
  //! Sphere. \throw vpException (badValue) naming the radius unless it is > 0 and at most vpLargestLength.
  [[nodiscard]] static vpCollisionShape sphere(double radius);
  /*!
   * Capsule along z.
   * \param radius : Radius of tube and caps, > 0.
   * \param length : Distance between the centres of the two caps, >= 0.
   * \throw vpException (badValue) naming the number: radius not > 0, length not >= 0, or out of range.
   */
  [[nodiscard]] static vpCollisionShape capsule(double radius, double length);
  //! Box. \param size : Lengths of the edges, m. \throw vpException (badValue) naming the one that is out of range.
  [[nodiscard]] static vpCollisionShape box(const Eigen::Vector3d &size);
  //! Cylinder along z. \throw vpException (badValue) naming radius or length if out of range.
  [[nodiscard]] static vpCollisionShape cylinder(double radius, double length);
  /*!
   * Triangle mesh.
   * \throw vpException (badValue) naming the mesh: a solid was requested, but it has holes or edges of more than two
   * triangles and thus no inside.
   */
  [[nodiscard]] static vpCollisionShape mesh(const vpTriangleMesh &mesh, vpMeshUse use = vpMeshUse::Solid);
  //! Octree: occupied cubes.
  [[nodiscard]] static vpCollisionShape octree(const vpOctree &octree);

  //! Kind of the shape.
  [[nodiscard]] vpShapeType type() const noexcept { return m_type; }
  //! Radius of a sphere, capsule or cylinder, m; 0 for the others.
  [[nodiscard]] double radius() const noexcept { return m_radius; }
  //! Length of a capsule (between the centres of its caps) or cylinder, m; 0 for the others.
  [[nodiscard]] double length() const noexcept { return m_length; }
  //! Lengths of a box's edges, m; 0 for the others.
  [[nodiscard]] const Eigen::Vector3d &size() const noexcept { return m_size; }
  //! The mesh; only for vpShapeType::Mesh.
  [[nodiscard]] const vpTriangleMesh &mesh() const { return m_mesh.value(); }
  //! The octree; only for vpShapeType::Octree.
  [[nodiscard]] const vpOctree &octree() const { return m_octree.value(); }

private:
  vpCollisionShape() = default;

  vpShapeType m_type = vpShapeType::Sphere;
  double m_radius = 0.;
  double m_length = 0.;
  Eigen::Vector3d m_size = Eigen::Vector3d::Zero();
  std::optional<vpTriangleMesh> m_mesh;
  std::optional<vpOctree> m_octree;
};

END_VISP_NAMESPACE
#endif
