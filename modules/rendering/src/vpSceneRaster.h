/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSceneRaster.h
 * \brief Depth and grey value of every pixel of a camera.
 */
#ifndef vpSceneRaster_h
#define vpSceneRaster_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpImage.h>

BEGIN_VISP_NAMESPACE

/*!
 * Each body is intersected with the rays of the pixels in its bounding sphere; the nearest intersection is kept.
 */
class vpSceneRaster
{
public:
  //! \param camera : Without distortion. \param width, height : Image size, px.
  vpSceneRaster(const vpCameraParameters &camera, unsigned int width, unsigned int height);

  //! Draws a scene. \param grey : Overwritten where something is seen; null: depths only.
  void draw(const vpCollisionScene &scene, const vpRigidTransform &fMc, vpImage<unsigned char> *grey);
  //! Depth along the optical axis, m; infinity where nothing is seen.
  [[nodiscard]] const vpImage<float> &depth() const { return m_depth; }
  //! Ray of a pixel, with a z of 1: the depth is its parameter.
  [[nodiscard]] Eigen::Vector3d ray(double u, double v) const
  {
    return {(u - m_camera.get_u0()) * m_camera.get_px_inverse(), (v - m_camera.get_v0()) * m_camera.get_py_inverse(),
            1.};
  }

private:
  struct Window {
    int left, top, right, bottom; // pixels, all included
  };
  [[nodiscard]] Window window(const Eigen::Vector3d &centre, double radius) const;
  // The bounding sphere is in the camera's frame.
  template <class Body>
  void drawBody(const Body &body, const vpRigidTransform &cMo, const Eigen::Vector3d &centre, double radius);
  template <class Body> void drawIn(const Window &w, const Body &body, const vpRigidTransform &cMo);
  void drawBox(const Eigen::Vector3d &half, const vpRigidTransform &cMo);
  void drawObject(const vpCollisionObject &object, const vpRigidTransform &cMf);
  void drawGround(const vpHalfSpace &ground, const vpRigidTransform &fMc);

  vpCameraParameters m_camera;
  int m_width, m_height;
  vpImage<float> m_depth;
  // While drawing.
  vpImage<unsigned char> *m_grey = nullptr;
  Eigen::Vector3d m_light = Eigen::Vector3d::UnitZ(); // in the camera frame
  double m_tone = 0.;                                 // grey tone of the object
};

END_VISP_NAMESPACE
#endif
