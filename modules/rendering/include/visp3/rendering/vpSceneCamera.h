/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSceneCamera.h
 * \brief Pictures and depth images of a whole scene of obstacles.
 */
#ifndef vpSceneCamera_h
#define vpSceneCamera_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/rendering/vpPlaneRenderer.h>

#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_rendering
 * \brief A photograph on the front of a box.
 */
struct VISP_EXPORT vpScenePhoto {
  std::string object;           //!< Name of a box in the scene; while there is none of that name nothing is drawn.
  vpImage<unsigned char> image; //!< Edge to edge on the face z = -size.z / 2, x right, y down; at least 8x8 px.
  Eigen::Vector2d size = Eigen::Vector2d::Zero(); //!< Width and height of the box, m, > 0.
};

/*!
 * \ingroup group_rendering
 * \brief What makes a vpSceneCamera.
 */
struct VISP_EXPORT vpSceneCameraSpec {
  vpCameraParameters camera = vpCameraParameters(600., 600., 319.5, 239.5); //!< Without distortion.
  unsigned int width = 640;                                                 //!< px, at least 8.
  unsigned int height = 480;                                                //!< px, at least 8.
  std::vector<vpScenePhoto> photos;                                         //!< At most one an object.
};

//! \ingroup group_rendering
//! \brief What a real depth camera adds to ideal depths. The defaults change nothing.
struct VISP_EXPORT vpDepthFaults {
  double noise = 0.;    //!< Standard deviation at a depth of 1 m, m; it grows with the square of the depth. >= 0.
  double dropout = 0.;  //!< Share of the pixels without a depth, 0..1.
  double maxDepth = 4.; //!< Beyond there is no depth, m, > 0.

  //! \throw vpException (badValue) naming the field and its value when one is out of its range or not finite.
  void validate() const;
};

/*!
 * \class vpSceneCamera
 * \ingroup group_rendering
 * \brief A camera among obstacles: grey pictures, with real photographs on boxes, and depth images.
 *
 * Every shape is cut exactly by the ray of each pixel's centre: sphere, capsule, box, cylinder, triangles of a mesh,
 * cubes of an octree, and the ground. What is nearest is seen. Photographs are drawn as by vpPlaneRenderer, all other
 * faces in plain greys by their names and directions, so that they offer few keypoints. The uncertainty
 * (vpCollisionObject::inflation) is not seen, nor is the arm, nor a body from its inside. Not for two threads at once.
 */
class VISP_EXPORT vpSceneCamera
{
public:
  /*!
   * \throw vpException (badValue) naming what is wrong: a camera with distortion or without focal length, a size below
   * 8 px, a photograph that is too small, has no size or is on an object that has one already.
   */
  explicit vpSceneCamera(const vpSceneCameraSpec &spec);
  ~vpSceneCamera();
  vpSceneCamera(vpSceneCamera &&) noexcept;            //!< Moves.
  vpSceneCamera &operator=(vpSceneCamera &&) noexcept; //!< Moves.

  //! What it was made from.
  [[nodiscard]] const vpSceneCameraSpec &spec() const noexcept;
  /*!
   * A picture.
   * \param scene : Objects where they are. \param fMc : Camera in the base. \param faults : What the camera adds;
   * there is no occluder, since objects hide each other. \param seed : Of the noise. \param image : Result.
   * \throw vpException (badValue) naming a fault that is out of its range, or an object with a photograph that is no box of
   * the photograph's size.
   */
  void picture(const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpCameraFaults &faults,
               unsigned int seed, vpImage<unsigned char> &image);
  /*!
   * A depth image: along the optical axis, m; 0 where there is nothing.
   * Parameters and errors as for picture(); needs no photographs.
   */
  void depth(const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpDepthFaults &faults, unsigned int seed,
             vpImage<float> &image);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
