/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDepthOctomap.h
 * \brief Occupancy map from depth images. Requires a build with octomap.
 */
#ifndef vpDepthOctomap_h
#define vpDepthOctomap_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpImage.h>

#include <memory>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpDepthOctomap.
 */
struct VISP_EXPORT vpDepthOctomapSpec {
  double resolution = 0.02;    //!< Edge of the smallest cube, m, > 0.
  double minRange = 0.1;       //!< Nearer points are ignored, m from the camera's centre, >= 0.
  double maxRange = 2.;        //!< Farther points only mark free space up to this range, m, > minRange.
  bool carve = true;           //!< Marks the space in front of a point as free, which clears removed obstacles.
  int stride = 1;              //!< Every stride-th row and column is used, >= 1.
  double bodyInflation = 0.02; //!< Points closer to the arm's capsules are attributed to the arm, m, >= 0.
};

//! \ingroup group_avoidance
//! \brief Status of inserting a depth image.
enum class vpDepthStatus {
  Ok,      //!< Points were used.
  NoPoint, //!< The image is empty, or all pixels are out of range or on the arm.
  BadInput //!< The camera pose is not a rigid transform within vpLargestLength, or its focal lengths are 0.
};

/*!
 * \ingroup group_avoidance
 * \brief Statistics of the pixels used.
 */
struct VISP_EXPORT vpDepthReport {
  vpDepthStatus status = vpDepthStatus::BadInput; //!< Ok, or the reason for failure.
  int used = 0;                                   //!< Points that mark occupied space.
  int body = 0;                                   //!< Excluded: on the arm itself.
  int known = 0;                                  //!< Excluded: on known objects and ground, see vpDepthObstacles.
  int invalid = 0;                                //!< Excluded: no depth (not finite or <= 0) or nearer than minRange.
  int beyond = 0;                                 //!< Farther than maxRange: mark free space only.

  //! Status as a sentence.
  [[nodiscard]] const char *message() const noexcept;
};

/*!
 * \class vpDepthOctomap
 * \ingroup group_avoidance
 * \brief Map of occupied space in the base frame, by octomap \cite Hornung13, built from depth images. Not thread-safe.
 *
 * \code
 * vpDepthOctomap map; // cubes of 2 cm, up to 2 m
 * vpArmData data;
 * vpArmKinematics::update(arm, q, data); // when the image was taken
 * const vpDepthReport report = map.insert(depth, camera, vpArmKinematics::camera(arm, data)); // m
 * if (report.status != vpDepthStatus::Ok) {
 *   std::cerr << report.message() << std::endl;
 * }
 * vpCollisionObject seen;
 * seen.name = "map";
 * seen.shape = vpCollisionShape::octree(map.snapshot());
 * scene.add(seen);
 * \endcode
 */
class VISP_EXPORT vpDepthOctomap
{
public:
  //! \throw vpException (badValue) naming the parameter and its value.
  explicit vpDepthOctomap(const vpDepthOctomapSpec &spec = {});
  ~vpDepthOctomap();
  vpDepthOctomap(vpDepthOctomap &&other) noexcept;            //!< Moves.
  vpDepthOctomap &operator=(vpDepthOctomap &&other) noexcept; //!< Moves.

  /*!
   * Adds an image. Allocates.
   * \param depth : Depth along the optical axis, m; <= 0, infinite or NaN where there is none.
   * \param camera : Intrinsics of the depth image; all projection models of ViSP.
   * \param fMc : Camera in the base when the image was taken.
   */
  vpDepthReport insert(const vpImage<float> &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc);
  /*!
   * Adds an image without the points on the arm.
   * \param depth, camera, fMc : As above.
   * \param scene : Scene with the arm's capsules.
   * \param placed : Arm configuration when the image was taken, by vpCollisionScene::place().
   */
  vpDepthReport insert(const vpImage<float> &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc,
                       const vpCollisionScene &scene, const vpCollisionData &placed);
  //! Clears the map.
  void clear();
  //! Current occupied cubes, for a vpCollisionShape with the identity as pose.
  [[nodiscard]] vpOctree snapshot() const;
  //! Writes an octomap .bt file. \throw vpException (ioError) naming the file on failure.
  void save(const std::string &file) const;

private:
  struct Map;
  vpDepthReport insert(const vpImage<float> &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc,
                       const vpPlacedCapsule *capsules, int count);

  vpDepthOctomapSpec m_spec;
  std::unique_ptr<Map> m_map;
};

END_VISP_NAMESPACE
#endif
