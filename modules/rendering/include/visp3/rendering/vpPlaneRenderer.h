/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlaneRenderer.h
 * \brief Renders a real photograph as a plane in space, with the faults of a real camera.
 */
#ifndef vpPlaneRenderer_h
#define vpPlaneRenderer_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpField.h>

#include <memory>

BEGIN_VISP_NAMESPACE

//! \ingroup group_rendering
//! \brief Imperfections of a real camera, applied to an ideal image. The defaults change nothing.
struct VISP_EXPORT vpCameraFaults {
  double noise = 0.;         //!< Standard deviation of the grey value, whose scale is 0 to 255, >= 0.
  double blur = 0.;          //!< Standard deviation of a Gaussian blur, px, 0..5.
  double gain = 1.;          //!< Factor on the grey value, > 0.
  double bias = 0.;          //!< Offset added to the grey value, finite.
  double occlusion = 0.;     //!< Fraction of the target's image area that a textured blob hides, 0..0.9.
  unsigned int occluder = 0; //!< Seed of the blob's position, fixed on the target, and of its texture.

  //! The numbers with their ranges and units; #occluder may be any.
  [[nodiscard]] static const vpFields<vpCameraFaults> &fields();
  //! \throw vpException (badValue) naming the field and its value if one is out of range.
  void validate() const;
};

/*!
 * \class vpPlaneRenderer
 * \ingroup group_rendering
 * \brief Renders a photograph as a rectangle in the plane z = 0, centred at the object's origin, in front of a faint
 * background.
 *
 * Convention: the photograph of W x H pixels covers the object edge to edge, the centre of its pixel (u, v) lies at
 * x = ((u + 1/2) / W - 1/2) objectWidth, y likewise. Image point (0, 0) is the centre of the top left pixel.
 * Each pixel is the mean of 2x2 samples of a pyramid level of similar resolution (anti-aliasing).
 *
 * \code
 * vpImageIo::read(photo, "data/target/klimt.jpg");
 * vpPlaneRenderer view(photo, 0.16, 0.16, vpCameraParameters(800., 800., 319.5, 239.5), 640, 480); // m, px
 * vpCameraFaults faults;
 * faults.noise = 2.; // grey levels
 * faults.blur = 0.5; // px
 * view.render(vpHomogeneousMatrix(0.02, 0., 0.5, 0.2, -0.3, 0.1), faults, 1, image); // cMo, m and rad; seed
 * \endcode
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
   * Renders the view at \e cMo.
   * \param cMo : Pose of the object in the camera. An object behind or beside the camera gives the background only.
   * \param faults : Camera imperfections. \param seed : Seed of the noise. \param image : Result, resized if needed.
   * \throw vpException (badValue) naming a fault that is out of range.
   */
  void render(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
              vpImage<unsigned char> &image);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
