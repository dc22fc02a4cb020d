/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDepthObstacles.h
 * \brief What depth images show and nobody knows, as one object of a scene. Needs octomap when the module is built.
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
  vpDepthOctomapSpec map = defaultMap(); //!< Of the map; by default every fourth row and column is used.
  std::string name = "depth";            //!< Of the object in the scene; not empty.
  double inflation = 0.;                 //!< Of that object, m, >= 0.
  double knownMargin = 0.03;             //!< Points that near to an object of the scene are that object, m, >= 0.

  //! vpDepthOctomapSpec with a stride that a control loop can afford.
  [[nodiscard]] static vpDepthOctomapSpec defaultMap() noexcept;
  //! \throw vpException (badValue) naming the field that is out of range, and its value; the map checks its own.
  void validate() const;
};

/*!
 * \class vpDepthObstacles
 * \ingroup group_avoidance
 * \brief Second source of obstacles beside vpObjectTracks: a map of what depth images show, as one octree at rest.
 *
 * Points on objects that the scene has, with their inflation, and on its ground are left out: a tracked object would
 * stand in the scene twice, which is safe, but also leave cubes behind where it was until they are carved, which blocks
 * ways that are free. What was mapped before its picture was recognised stays until it is carved: safe, and in the way
 * for a while. Points beside a tracked object, because it is not where it is thought to be, go into the map.
 */
class VISP_EXPORT vpDepthObstacles
{
public:
  //! \throw vpException (badValue) naming the parameter and its value.
  explicit vpDepthObstacles(const vpDepthObstaclesSpec &spec = {});

  /*!
   * Adds a depth image. Allocates.
   * \param depth, camera, fMc : As for vpDepthOctomap::insert().
   * \param scene : Objects that are known when the image was taken (as perceived), and the arm.
   * \param placed : Of the configuration when the image was taken, by vpCollisionScene::place().
   */
  vpDepthReport insert(const vpImage<float> &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc,
                       const vpCollisionScene &scene, const vpCollisionData &placed);
  /*!
   * Brings the map into a scene: its object is replaced when cubes came or went, and removed when there are none.
   * Allocates.
   * \return True when the list of objects changed.
   * \throw vpException (badValue) when the scene has an object of that name from somebody else.
   */
  bool applyTo(vpCollisionScene &scene);
  //! The map.
  [[nodiscard]] const vpDepthOctomap &map() const noexcept { return m_map; }
  //! Forgets everything; the next applyTo() removes the object.
  void clear();

private:
  vpDepthObstaclesSpec m_spec;
  vpDepthOctomap m_map;
  vpImage<float> m_unknown; // the depth image without what is known
  std::vector<vpOctreeCell> m_applied;
  bool m_isNew = false; // the map has changed since it was applied
};

END_VISP_NAMESPACE
#endif
