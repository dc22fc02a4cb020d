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

//! \ingroup group_rendering
//! \brief What a real camera adds to an ideal picture. The defaults change nothing.
struct VISP_EXPORT vpCameraFaults {
  double noise = 0.;         //!< Standard deviation of the grey value, 0..255 scale, >= 0.
  double blur = 0.;          //!< Standard deviation of a Gaussian blur, px, 0..5.
  double gain = 1.;          //!< Factor on the grey value, > 0.
  double bias = 0.;          //!< Added to the grey value.
  double occlusion = 0.;     //!< Share of the target's area in the picture that a textured blob hides, 0..0.9.
  unsigned int occluder = 0; //!< Which blob: seed of its place on the target, to which it sticks, and of its texture.

  //! \throw vpException (badValue) naming the field and its value when one is out of its range or not finite.
  void validate() const;
};

/*!
 * \class vpPlaneRenderer
 * \ingroup group_rendering
 * \brief Renders a photograph, taken as a rectangle in the plane z = 0 centred at the object's origin, before a faint
 * background.
 *
 * Convention: the photograph of W x H pixels covers the object edge to edge, the centre of its pixel (u, v) lies at
 * x = ((u + 1/2) / W - 1/2) objectWidth, y likewise. Pixel (0, 0) of the picture is the centre of its top left pixel.
 * Each pixel is the mean of 2x2 samples, of a copy of the photograph that is about as fine as these (against aliasing).
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
  vpPlaneRenderer(vpPlaneRenderer &&) noexcept;            //!< Moves.
  vpPlaneRenderer &operator=(vpPlaneRenderer &&) noexcept; //!< Moves.

  /*!
   * Render the view from \e cMo.
   * \param cMo : Pose of the object in the camera. An object behind or beside the camera gives the background only.
   * \param faults : What the camera adds. \param seed : Seed of the noise. \param image : Result, resized when needed.
   * \throw vpException (badValue) naming a fault that is out of its range.
   */
  void render(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
              vpImage<unsigned char> &image);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
