/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDepthOctomap.h
 * \brief Obstacles from depth images. Needs octomap when the module is built.
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
  double minRange = 0.1;       //!< Nearer points are not used, m from the camera's centre, >= 0.
  double maxRange = 2.;        //!< Farther points are not used but show free space up to here, m, > minRange.
  bool carve = true;           //!< Space in front of a point is free: clears what has gone.
  int stride = 1;              //!< Every stride-th row and column, >= 1.
  double bodyInflation = 0.02; //!< Points that near to the arm's own capsules are the arm, m, >= 0.
};

//! \ingroup group_avoidance
//! \brief How the use of a depth image went.
enum class vpDepthStatus {
  Ok,      //!< Points were used.
  NoPoint, //!< The image is empty, or no pixel has a depth in range that is not the arm.
  BadInput //!< The camera's pose is no rotation and place within vpLargestLength, or its focal lengths are 0.
};

/*!
 * \ingroup group_avoidance
 * \brief What became of the pixels that were looked at.
 */
struct VISP_EXPORT vpDepthReport {
  vpDepthStatus status = vpDepthStatus::BadInput; //!< Ok, or why not.
  int used = 0;                                   //!< Points that mark occupied space.
  int body = 0;                                   //!< Left out: the arm itself.
  int known = 0;                                  //!< Left out: known objects and ground, see vpDepthObstacles.
  int invalid = 0;                                //!< Left out: no depth (not finite or <= 0) or nearer than minRange.
  int beyond = 0;                                 //!< Farther than maxRange: show free space only.

  //! One sentence for the status.
  [[nodiscard]] const char *sentence() const noexcept;
};

/*!
 * \class vpDepthOctomap
 * \ingroup group_avoidance
 * \brief Map of occupied space in the base frame, by octomap \cite Hornung13, fed with depth images. Not for two threads at once.
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
   * \param depth : Along the optical axis, m; <= 0, infinite or NaN where there is none.
   * \param camera : Of the depth image; all of ViSP's projection models.
   * \param fMc : Camera in the base when the image was taken.
   */
  vpDepthReport insert(const vpImage<float> &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc);
  /*!
   * The same without the points on the arm.
   * \param depth, camera, fMc : As above.
   * \param scene : For the arm's capsules.
   * \param placed : Of the configuration when the image was taken, by vpCollisionScene::place().
   */
  vpDepthReport insert(const vpImage<float> &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc,
                       const vpCollisionScene &scene, const vpCollisionData &placed);
  //! Forgets everything.
  void clear();
  //! Occupied cubes now, for a vpCollisionShape with the identity as pose.
  [[nodiscard]] vpOctree snapshot() const;
  //! Writes a .bt file of octomap. \throw vpException (ioError) naming the file when it cannot.
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
