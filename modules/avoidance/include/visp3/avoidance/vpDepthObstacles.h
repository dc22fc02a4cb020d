/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDepthObstacles.h
 * \brief Unknown obstacles from depth images, as one object of a scene. Requires a build with octomap.
 */
#ifndef vpDepthObstacles_h
#define vpDepthObstacles_h

#include <visp3/avoidance/vpDepthOctomap.h>

#include <string>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpDepthObstacles.
 */
struct VISP_EXPORT vpDepthObstaclesSpec {
  vpDepthOctomapSpec map = defaultMap(); //!< Parameters of the map; default: every fourth row and column.
  std::string name = "depth";            //!< Name of the object in the scene; not empty.
  double inflation = 0.;                 //!< Inflation of that object, m, >= 0.
  double knownMargin = 0.03;             //!< Points closer to a scene object are attributed to it, m, >= 0.

  //! Default parameters of the map, with a stride fast enough for a control loop.
  [[nodiscard]] static vpDepthOctomapSpec defaultMap() noexcept;
  //! \throw vpException (badValue) naming the field that is out of range, and its value; the map checks its own.
  void validate() const;
};

/*!
 * \class vpDepthObstacles
 * \ingroup group_avoidance
 * \brief Second source of obstacles besides vpObjectTracks: a map from depth images, as one static octree.
 *
 * Points on scene objects (with their inflation) and on the ground are excluded: otherwise a tracked object would be in
 * the scene twice, which is safe, but it would also leave cubes at its old positions until they are carved, which block
 * free paths. What was mapped before its object was recognised remains until it is carved: safe, but temporarily in the
 * way. Points beside a tracked object, due to an error of its pose, enter the map.
 *
 * \code
 * vpDepthObstacles obstacles;
 * vpCollisionData placed;
 * scene.place(q, placed); // when the image was taken
 * const vpRigidTransform fMc = vpArmKinematics::camera(arm, placed.arm);
 * const vpDepthReport report = obstacles.insert(depth, camera, fMc, scene, placed); // each image, m
 * if (report.status == vpDepthStatus::BadInput) {
 *   std::cerr << report.message() << std::endl;
 * }
 * obstacles.applyTo(scene); // the object "depth"
 * \endcode
 */
class VISP_EXPORT vpDepthObstacles
{
public:
  //! \throw vpException (badValue) naming the parameter and its value.
  explicit vpDepthObstacles(const vpDepthObstaclesSpec &spec = {});

  /*!
   * Adds a depth image. Allocates.
   * \param depth, camera, fMc : As for vpDepthOctomap::insert().
   * \param scene : Objects known when the image was taken (as perceived), and the arm.
   * \param placed : Arm configuration when the image was taken, by vpCollisionScene::place().
   */
  vpDepthReport insert(const vpImage<float> &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc,
                       const vpCollisionScene &scene, const vpCollisionData &placed);
  /*!
   * Updates the map's object in a scene: replaced if cubes changed, removed if there are none. Allocates.
   * \return True if the list of objects changed.
   * \throw vpException (badValue) if the scene has an object of that name from another source.
   */
  bool applyTo(vpCollisionScene &scene);
  //! The map.
  [[nodiscard]] const vpDepthOctomap &map() const noexcept { return m_map; }
  //! Clears the map; the next applyTo() removes the object.
  void clear();

private:
  vpDepthObstaclesSpec m_spec;
  vpDepthOctomap m_map;
  vpImage<float> m_unknown; // depth image without the known points
  std::vector<vpOctreeCell> m_applied;
  bool m_isNew = false; // the map has changed since it was applied
};

END_VISP_NAMESPACE
#endif
