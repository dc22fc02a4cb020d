/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpExactShapes.h
 * \brief Exact shapes of an arm's bodies, for collision checks where capsules do not decide. Requires a build with FCL.
 */
#ifndef vpExactShapes_h
#define vpExactShapes_h

#include <visp3/manipulator/vpArmModel.h>

#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

struct vpExactBody;

/*!
 * \class vpExactShapes
 * \ingroup group_avoidance
 * \brief The shapes of an arm's bodies (vpArmSpec::shapes) as triangles, for distances by FCL \cite Pan12 . Immutable;
 * may be shared by scenes and threads.
 *
 * A body has an exact shape if it has capsules and these enclose it: all vertices of its shapes are checked. A
 * box and a mesh are taken as they are, a cylinder as the prism of 48 sides around it, whose edges stand out by 0.2 %
 * of the radius, and a sphere as a triangle of 0.01 mm at its centre with the radius around it, less than 0.02 mm more
 * than the sphere. A body without capsules is not seen by any check, and one whose capsules do not enclose it is known
 * by these alone; warnings() names the latter. Where exact shapes decide, they are all that is known of a body: give a
 * capsule that stands for more, such as a cable, no body.
 *
 * An obstacle inside a closed mesh, without touching its surface, is in contact: the inside is where the winding number
 * exceeds 1/2. A mesh with holes has such an inside only away from its holes.
 *
 * \code
 * vpCollisionSceneSpec spec;
 * spec.exact = std::make_shared<vpExactShapes>(arm); // throws, naming a mesh that cannot be read
 * for (const std::string &warning : spec.exact->warnings()) {
 *   std::cerr << warning << std::endl; // bodies known by their capsules alone
 * }
 * const vpCollisionScene exact(arm, spec); // for vpPathPlanner and vpCertifiedMotion
 * \endcode
 */
class VISP_EXPORT vpExactShapes
{
public:
  /*!
   * Loads the meshes; for set-up.
   * \throw vpException (notImplementedError) naming FCL if built without it; (ioError, badValue) naming a mesh file
   * that cannot be read.
   */
  explicit vpExactShapes(const vpArmModel &arm);
  ~vpExactShapes();
  vpExactShapes(const vpExactShapes &) = delete;
  vpExactShapes &operator=(const vpExactShapes &) = delete;

  //! True if body \e i of vpArmSpec::bodies has an exact shape; false for -1.
  [[nodiscard]] bool has(int i) const noexcept;
  //! Largest distance of the surface of body \e i from the convex hull of the axes of its capsules, m, or more: a joint
  //! that turns by dq moves it by at most this distance times dq more than the axes.
  [[nodiscard]] double thickness(int i) const noexcept;
  //! True if the shapes were made for an arm of the same bodies and capsules.
  [[nodiscard]] bool isOf(const vpArmModel &arm) const noexcept;
  //! Bodies whose capsules do not enclose their shapes: one sentence each.
  [[nodiscard]] const std::vector<std::string> &warnings() const noexcept { return m_warnings; }
  //! For this module's own use: body \e i, which has an exact shape.
  [[nodiscard]] const vpExactBody &body(int i) const noexcept;

private:
  std::vector<std::unique_ptr<const vpExactBody>> m_bodies;
  std::vector<std::string> m_names;
  std::vector<vpArmCapsule> m_capsules;
  std::vector<std::string> m_warnings;
};

END_VISP_NAMESPACE
#endif
