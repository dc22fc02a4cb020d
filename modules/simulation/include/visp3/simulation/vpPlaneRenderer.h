/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlaneRenderer.h
 * \brief Pictures of a real photograph as a plane in space, with the faults of a real camera.
 */
#ifndef vpPlaneRenderer_h
#define vpPlaneRenderer_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <memory>

BEGIN_VISP_NAMESPACE

//! \brief What a real camera adds to an ideal picture. The defaults change nothing.
struct VISP_EXPORT vpCameraFaults {
  double noise = 0.;     //!< Standard deviation of the grey value, 0..255 scale, >= 0.
  double blur = 0.;      //!< Standard deviation of a Gaussian blur, px, >= 0.
  double gain = 1.;      //!< Factor on the grey value, > 0.
  double bias = 0.;      //!< Added to the grey value.
  double occlusion = 0.; //!< Share of the target's area that a textured blob hides, 0..0.9.
};

/*!
 * \class vpPlaneRenderer
 * \ingroup group_simulation
 * \brief Renders a photograph, taken as a rectangle in the plane z = 0 centred at the object's origin, through ViSP's
 * vpImageSimulator (supersampled against aliasing) before a textured background.
 */
class VISP_EXPORT vpPlaneRenderer
{
public:
  /*!
   * \param photo : The texture; at least 8x8 px.
   * \param objectWidth, objectHeight : Size of the rectangle, m, > 0.
   * \param camera : Intrinsics without distortion. \param width, height : Image size, px.
   * \throw vpException (badValue) naming the argument and its value.
   */
  vpPlaneRenderer(const vpImage<unsigned char> &photo, double objectWidth, double objectHeight,
                  const vpCameraParameters &camera, unsigned int width, unsigned int height);
  ~vpPlaneRenderer();
  vpPlaneRenderer(vpPlaneRenderer &&) noexcept;
  vpPlaneRenderer &operator=(vpPlaneRenderer &&) noexcept;

  /*!
   * Render the view from \e cMo.
   * \param cMo : Pose of the object in the camera. An object behind or beside the camera gives the background only.
   * \param faults : What the camera adds. \param seed : Seed of noise and of the occluder's place.
   * \param image : Result, resized when needed.
   */
  void render(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
              vpImage<unsigned char> &image);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
