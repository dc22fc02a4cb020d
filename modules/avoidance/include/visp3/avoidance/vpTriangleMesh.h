/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTriangleMesh.h
 * \brief Surface of triangles, from memory or from an .obj or .stl file.
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
 * \brief Immutable surface with a tree of boxes for distances; copies share it.
 *
 * Vertices at the same place are joined, since formats repeat them: for every triangle, or for a texture at a seam. A closed
 * surface (every edge in two triangles) is a solid: points inside have a negative distance, whatever the sense of the
 * triangles; a shell inside another one that is turned the other way is a cavity. A surface with holes has no inside, and
 * sentence() says so; vpCollisionShape::mesh() refuses it unless a sheet is asked for.
 */
class VISP_EXPORT vpTriangleMesh
{
public:
  /*!
   * \param vertices : m, in the mesh's frame.
   * \param triangles : Three indices into \e vertices each. Those without area are left out.
   * \param label : For messages: a file's name.
   * \throw vpException (badValue) naming \e label and the element: no triangle with an area, an index out of range, a
   * vertex that is not finite or beyond vpLargestLength.
   */
  vpTriangleMesh(const std::vector<Eigen::Vector3d> &vertices, const std::vector<std::array<int, 3>> &triangles,
                 const std::string &label = "mesh");
  /*!
   * \param file : Wavefront .obj (only v and f lines count; polygons become fans) or .stl, text or binary.
   * \param scale : m in one unit of the file, > 0: 0.001 for millimetres.
   * \throw vpException (ioError) when the file cannot be read, (badValue) naming the file and its line or triangle.
   */
  [[nodiscard]] static vpTriangleMesh load(const std::string &file, double scale = 1.);

  //! m; no two at the same place.
  [[nodiscard]] const std::vector<Eigen::Vector3d> &vertices() const noexcept;
  //! Indices into vertices(); of a solid, in the sense that is against the clock seen from outside.
  [[nodiscard]] const std::vector<std::array<int, 3>> &triangles() const noexcept;
  //! True for a solid: a closed surface that can be oriented.
  [[nodiscard]] bool isWatertight() const noexcept;
  //! What is wrong with it in one sentence with its label ("cup.obj: the surface has holes, ..."), or nothing.
  [[nodiscard]] const std::string &sentence() const noexcept;
  //! What it was called at construction.
  [[nodiscard]] const std::string &label() const noexcept;
  //! For this module's own use.
  [[nodiscard]] const vpTriangleMeshData &data() const noexcept { return *m_data; }

private:
  std::shared_ptr<const vpTriangleMeshData> m_data;
};

END_VISP_NAMESPACE
#endif
