/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCapsuleCover.h
 * \brief Covers of a mesh by a few capsules that enclose it.
 */
#ifndef vpCapsuleCover_h
#define vpCapsuleCover_h

#include <visp3/avoidance/vpTriangleMesh.h>
#include <visp3/manipulator/vpArmSpec.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Options of vpFitCapsules().
struct VISP_EXPORT vpCapsuleCoverSpec {
  int count = 3;         //!< Maximum number of capsules, 1..8.
  double enough = 0.005; //!< No further capsule is added once the overhang is at most this, m, >= 0.
  unsigned int seed = 1; //!< Seed of the random search: the same seed gives the same cover.
};

/*!
 * \ingroup group_avoidance
 * \brief Capsules that together enclose a mesh, and how tightly.
 */
struct VISP_EXPORT vpCapsuleCover {
  std::vector<vpArmCapsule> capsules; //!< In the frame of the mesh; their link is 0, their body -1.
  /*!
   * Largest distance of the cover's surface from the mesh, outside of it, m; 0 if none is outside. It is measured at
   * samples that are at most a tenth of a capsule's radius from any point of its surface (on the tube at most an eighth
   * of its length along it): points between them may be farther out by as much.
   */
  double overhang = 0.;
  //! Volume of the union of the capsules over that of the mesh's convex hull, to about 2 %; 0 if the hull is flat.
  double volumeRatio = 0.;
  //! Half the least width of the mesh across any of its triangles, along an axis or in 600 directions, m; for a long
  //! cylinder this is its radius.
  double radius = 0.;
};

//! \ingroup group_avoidance
//! \brief Result of vpProveCover().
struct VISP_EXPORT vpCoverProof {
  bool enclosed = false; //!< The cover is proven to enclose the mesh.
  double outside = 0.;   //!< Largest distance of a checked point of the mesh from the cover, m.
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); //!< That point, in the frame of the mesh, m.
  std::string message;                             //!< Why it is not proven, in one sentence; empty if it is.
};

/*!
 * \ingroup group_avoidance
 * \brief Fits capsules that enclose a mesh, about as tightly as a few capsules can. Takes 0.1 to a few seconds.
 *
 * The triangles are divided into cells with edges of at most 2 cm or 12 % of the mesh; in a mesh with holes cubes of 1
 * cm with a winding number above 1/2 are cells, too. Each cell lies wholly in one capsule, since its corners do and a
 * capsule is convex. The inside of a closed mesh is then enclosed as well, see vpProveCover(). The fit minimises the
 * volume outside the mesh, weighted by the squared distance from it, from several starts; of their results the one of
 * least overhang times squared volume is taken. One more capsule must lower this by at least 2 %.
 *
 * \code
 * const vpTriangleMesh mesh = vpTriangleMesh::load("data/scene/bracket.obj", 0.001); // mm
 * const vpCapsuleCover cover = vpFitCapsules(mesh);
 * std::cout << cover.capsules.size() << " capsules, at most " << cover.overhang << " m too far out" << std::endl;
 * const vpCoverProof proof = vpProveCover(mesh, cover.capsules);
 * if (!proof.enclosed) {
 *   std::cerr << proof.message << std::endl;
 * }
 * \endcode
 * \throw vpException (badValue) naming the field and its value if out of range, or the mesh if it has more than two
 * million cells.
 */
[[nodiscard]] VISP_EXPORT vpCapsuleCover vpFitCapsules(const vpTriangleMesh &mesh, const vpCapsuleCoverSpec &spec = {});

/*!
 * \ingroup group_avoidance
 * \brief Measures overhang and volume ratio of any capsules about a mesh, enclosing or not.
 * \throw vpException (badValue) if there is no capsule, or naming the first that is not finite or without a radius.
 */
[[nodiscard]] VISP_EXPORT vpCapsuleCover vpMeasureCover(const vpTriangleMesh &mesh,
                                                        const std::vector<vpArmCapsule> &capsules);

/*!
 * \ingroup group_avoidance
 * \brief Proves that capsules enclose a mesh, its inside included.
 *
 * A triangle is proven when one capsule contains its corners; otherwise its halves are examined, down to 0.1 mm. The
 * capsules then contain the whole surface. Points inside a closed mesh could be left out only in a hollow that the
 * capsules enclose on all sides. The union of convex sets has the holes of its nerve (nerve theorem), and a nerve has
 * no hollow if removing capsules that touch at most two of the remaining ones, one after the other, removes all. So up
 * to three capsules never have one. For a mesh with holes the cubes of vpFitCapsules() must lie in one capsule each;
 * other points behind its surface are not checked. What is not proven may still be enclosed: a seam of capsules exactly
 * on the surface, more than three that all touch one another.
 *
 * \throw vpException (badValue) as vpMeasureCover().
 */
[[nodiscard]] VISP_EXPORT vpCoverProof vpProveCover(const vpTriangleMesh &mesh,
                                                    const std::vector<vpArmCapsule> &capsules);

END_VISP_NAMESPACE
#endif
