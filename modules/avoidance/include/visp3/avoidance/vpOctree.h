/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOctree.h
 * \brief Occupied space as cubes, from memory, from a file of octomap or from depth images (vpDepthOctomap).
 */
#ifndef vpOctree_h
#define vpOctree_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

struct vpOctreeData;

/*!
 * \ingroup group_avoidance
 * \brief One occupied cube, axes along those of the map.
 */
struct VISP_EXPORT vpOctreeCell {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); //!< Centre in the map frame, m.
  double size = 0.;                                 //!< Length of an edge, m, > 0.
};

/*!
 * \class vpOctree
 * \ingroup group_avoidance
 * \brief Immutable set of occupied cubes with a bounding-box tree for distances; copies share it. Unknown space counts
 * as free. May be empty.
 *
 * \code
 * vpCollisionObject seen;
 * seen.name = "map";
 * seen.shape = vpCollisionShape::octree(vpOctree::load("data/scene/seen.bt")); // throws, naming the file
 * scene.add(seen);
 * std::cout << seen.shape.octree().cells().size() << " occupied cubes" << std::endl;
 * \endcode
 */
class VISP_EXPORT vpOctree
{
public:
  /*!
   * \param cells : Cubes of any size.
   * \param label : For messages.
   * \throw vpException (badValue) naming \e label and the first cell that is not finite or has a size not > 0.
   */
  explicit vpOctree(const std::vector<vpOctreeCell> &cells, const std::string &label = "octree");
  /*!
   * Loads the occupied leaves of an octomap .bt or .ot file.
   * \throw vpException (ioError) if it cannot be read, (fatalError) if the module was built without octomap.
   */
  [[nodiscard]] static vpOctree load(const std::string &file);

  //! The cubes.
  [[nodiscard]] const std::vector<vpOctreeCell> &cells() const &noexcept;
  //! A copy, for a loop over the cubes of a temporary: `for (const auto &cell : map.snapshot().cells())`.
  [[nodiscard]] std::vector<vpOctreeCell> cells() && { return static_cast<const vpOctree &>(*this).cells(); }
  //! The label given at construction.
  [[nodiscard]] const std::string &label() const noexcept;
  //! For this module's own use.
  [[nodiscard]] const vpOctreeData &data() const noexcept { return *m_data; }

private:
  std::shared_ptr<const vpOctreeData> m_data;
};

END_VISP_NAMESPACE
#endif
