/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSceneCamera.h
 * \brief Renders grey and depth images of a scene of obstacles.
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
  std::string object;           //!< Name of a box in the scene; if there is none, nothing is drawn.
  vpImage<unsigned char> image; //!< Edge to edge on the face z = -size.z / 2, x right, y down; at least 8x8 px.
  Eigen::Vector2d size = Eigen::Vector2d::Zero(); //!< Width and height of the box, m, > 0.
};

/*!
 * \ingroup group_rendering
 * \brief Parameters of vpSceneCamera.
 */
struct VISP_EXPORT vpSceneCameraSpec {
  vpCameraParameters camera = vpCameraParameters(600., 600., 319.5, 239.5); //!< Intrinsics without distortion.
  unsigned int width = 640;                                                 //!< Image width, px, at least 8.
  unsigned int height = 480;                                                //!< Image height, px, at least 8.
  std::vector<vpScenePhoto> photos;                                         //!< Photographs, at most one per object.
};

//! \ingroup group_rendering
//! \brief Imperfections of a real depth camera, applied to ideal depths. The defaults change nothing.
struct VISP_EXPORT vpDepthFaults {
  double noise = 0.;    //!< Standard deviation at a depth of 1 m, m, >= 0; it grows with the square of the depth.
  double dropout = 0.;  //!< Fraction of pixels without depth, 0..1.
  double maxDepth = 4.; //!< Maximum range; no depth beyond, m, > 0.

  //! \throw vpException (badValue) naming the field and its value if one is out of range or not finite.
  void validate() const;
};

/*!
 * \class vpSceneCamera
 * \ingroup group_rendering
 * \brief Renders a vpCollisionScene: grey images, with real photographs on boxes, and depth images.
 *
 * The ray of each pixel's centre is intersected exactly with every shape: sphere, capsule, box, cylinder, triangles of
 * a mesh, cubes of an octree, and the ground; the nearest is seen. Photographs are drawn as by vpPlaneRenderer, all
 * other faces in uniform grey by name and direction, so that they offer few keypoints. Inflation
 * (vpCollisionObject::inflation), the arm and the inside of a body are not rendered. Not thread-safe.
 *
 * \code
 * vpSceneCamera camera{vpSceneCameraSpec()}; // 640 x 480 px
 * vpCollisionData placed;
 * scene.place(q, placed);
 * const vpRigidTransform fMc = vpArmKinematics::camera(scene.arm(), placed.arm);
 * camera.picture(scene, fMc, {}, 1, image); // grey; seed of the noise
 * vpDepthFaults faults;
 * faults.noise = 0.002; // m at 1 m
 * faults.dropout = 0.05;
 * vpImage<float> depth; // m; 0: nothing there
 * camera.depth(scene, fMc, faults, 1, depth);
 * \endcode
 */
class VISP_EXPORT vpSceneCamera
{
public:
  /*!
   * \throw vpException (badValue) naming the error: a camera with distortion or without focal length, a size below
   * 8 px, a photograph that is too small, has no size or is on an object that already has one.
   */
  explicit vpSceneCamera(const vpSceneCameraSpec &spec);
  ~vpSceneCamera();
  vpSceneCamera(vpSceneCamera &&) noexcept;            //!< Moves.
  vpSceneCamera &operator=(vpSceneCamera &&) noexcept; //!< Moves.

  //! Parameters of the camera.
  [[nodiscard]] const vpSceneCameraSpec &spec() const noexcept;
  /*!
   * Renders a grey image.
   * \param scene : The scene. \param fMc : Camera in the base. \param faults : Camera imperfections; the occluder is
   * not used, since objects hide each other. \param seed : Seed of the noise. \param image : Result.
   * \throw vpException (badValue) naming a fault that is out of range, or an object with a photograph that is not a box
   * of the photograph's size.
   */
  void picture(const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpCameraFaults &faults,
               unsigned int seed, vpImage<unsigned char> &image);
  /*!
   * Renders a depth image: depth along the optical axis, m; 0 where there is nothing.
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
