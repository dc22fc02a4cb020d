/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTriangleMesh.h
 * \brief Triangle mesh, from memory or from a .stl, .obj, .dae or .ply file.
 */
#ifndef vpTriangleMesh_h
#define vpTriangleMesh_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

struct vpTriangleMeshData;

/*!
 * \class vpTriangleMesh
 * \ingroup group_avoidance
 * \brief Immutable triangle surface with a bounding-box tree for distances; copies share it.
 *
 * Vertices at the same position are merged, since formats repeat them: per triangle, or at texture seams. A closed
 * surface (every edge in two triangles) is a solid: points inside have a negative distance, whatever the orientation of
 * the triangles; an inner shell of opposite orientation is a cavity. A surface with holes has no inside, which
 * message() reports; vpCollisionShape::mesh() rejects it unless a sheet is requested.
 *
 * \code
 * const vpTriangleMesh mesh = vpTriangleMesh::load("data/scene/bracket.obj", 0.001); // mm; throws, naming the file
 * std::cout << mesh.triangles().size() << " triangles" << std::endl;
 * if (!mesh.isWatertight()) {
 *   std::cerr << mesh.message() << std::endl; // only vpMeshUse::Surface takes it
 * }
 * \endcode
 */
class VISP_EXPORT vpTriangleMesh
{
public:
  /*!
   * \param vertices : Vertices in the mesh frame, m.
   * \param triangles : Three indices into \e vertices each. Degenerate triangles are dropped.
   * \param label : For messages: a file name.
   * \throw vpException (badValue) naming \e label and the element: no triangle with an area, an index out of range, a
   * vertex that is not finite or beyond vpLargestLength.
   */
  vpTriangleMesh(const std::vector<Eigen::Vector3d> &vertices, const std::vector<std::array<int, 3>> &triangles,
                 const std::string &label = "mesh");
  /*!
   * Loads a mesh file, read by assimp in single precision.
   * \param file : STL (text or binary), Wavefront .obj, Collada .dae, .ply; upper or lower case. Only vertices, faces
   * and, in Collada, their places and the unit are used; its up axis is ignored, as ROS does. Polygons become fans.
   * \param scale : Metres per unit of the file (.dae: factor on its metres), > 0: 0.001 for millimetres.
   * \throw vpException (ioError) if the file cannot be read, (badValue) naming the file and the reason,
   * (notImplementedError) in a build without assimp.
   */
  [[nodiscard]] static vpTriangleMesh load(const std::string &file, double scale = 1.);
  //! The same with a scale along each axis, not 0; negative ones mirror, and a solid stays one.
  [[nodiscard]] static vpTriangleMesh load(const std::string &file, const Eigen::Vector3d &scale);

  //! Distinct vertices, m.
  [[nodiscard]] const std::vector<Eigen::Vector3d> &vertices() const &noexcept;
  //! Indices into vertices(); for a solid, counter-clockwise seen from outside.
  [[nodiscard]] const std::vector<std::array<int, 3>> &triangles() const &noexcept;
  //! A copy, for a loop over the vertices of a temporary.
  [[nodiscard]] std::vector<Eigen::Vector3d> vertices() &&
  {
    return static_cast<const vpTriangleMesh &>(*this).vertices();
  }
  //! A copy, for a loop over the triangles of a temporary.
  [[nodiscard]] std::vector<std::array<int, 3>> triangles() &&
  {
    return static_cast<const vpTriangleMesh &>(*this).triangles();
  }
  //! True for a solid: a closed orientable surface.
  [[nodiscard]] bool isWatertight() const noexcept;
  //! Defect in one sentence with its label ("cup.obj: the surface has holes, ..."); empty if none.
  [[nodiscard]] const std::string &message() const noexcept;
  //! The label given at construction.
  [[nodiscard]] const std::string &label() const noexcept;
  //! For this module's own use.
  [[nodiscard]] const vpTriangleMeshData &data() const noexcept { return *m_data; }

private:
  std::shared_ptr<const vpTriangleMeshData> m_data;
};

END_VISP_NAMESPACE
#endif
