/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMicroscopeCalibration.h
 * \brief Maps between the image of a microscope and its product plane.
 */
#ifndef vpMicroscopeCalibration_h
#define vpMicroscopeCalibration_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <visp3/core/vpCameraParameters.h>

#include <Eigen/Core>

#include <string>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_pattern
 * \brief A camera that looks perpendicularly, or nearly so, at a plane (thesis section 7.2.1, equation (7.7)).
 *
 * With the pixel relative to the principal point, d = (u - u0, (v - v0) scaleX / scaleY), and a point p of the plane,
 * \verbatim
   d (1 + kappa1 |d|^2) = q / (1 + g . q),   q = scaleX (D R(theta) F p + t),   D = (1 + stretch      shear  )
                                                                                    (  shear     1 - stretch)
   \endverbatim
 * where F mirrors y when #mirrored is set and g = (tiltX, tiltY). With g and D - 1 zero this is (7.7), and scaleX its
 * magnification M_o = f / t_z in px per metre of product. A plane tilted by the angle a about the axis at the angle b
 * to u has |g| = sin a / distance, the distance in px, and is foreshortened across the axis by 1 - cos a.
 *
 * \code
 * vpMicroscopeCalibration microscope = vpMicroscopeCalibration::loadXml("microscope.xml", "microscope", 640, 480);
 * const Eigen::Vector2d p = microscope.toPlane(100., 50.); // px to m, from the principal point
 * std::cout << 1e6 * p.transpose() << " um; a pixel is " << microscope.pixelSizeUm() << " um" << std::endl;
 * \endcode
 */
struct VISP_EXPORT vpMicroscopeCalibration {
  unsigned int width = 0;  //!< Columns of the images, px.
  unsigned int height = 0; //!< Rows of the images, px.
  double scaleX = 1.;      //!< px per m along u, > 0.
  double scaleY = 1.;      //!< px per m along v, > 0.
  double rotation = 0.;    //!< theta: rotation of the product in the image, from u towards v (clockwise as seen), rad.
  bool mirrored = false;   //!< The image shows the product mirrored.
  double tx = 0.;          //!< Position of the product's origin along u, from the principal point, m.
  double ty = 0.;          //!< Position of the product's origin along v, from the principal point, m.
  double kappa1 = 0.;      //!< Radial distortion, px^-2 (columns); positive: barrel, negative: pincushion.
  double u0 = 0.;          //!< Principal point, px: the centre of the distortion.
  double v0 = 0.;          //!< Principal point, px.
  double tiltX = 0.;       //!< g: relative decrease of the scale along u, px^-1.
  double tiltY = 0.;       //!< g: relative decrease of the scale along v, px^-1.
  double stretch = 0.;     //!< D: relative stretch of a tilted plane along u and compression along v.
  double shear = 0.;       //!< D: relative stretch of a tilted plane along the diagonals.

  //! Position of a pixel on the product, m.
  [[nodiscard]] Eigen::Vector2d toPlane(double u, double v) const;
  //! Image position, px, of a point of the product, m. NaN where the distortion of a negative #kappa1 has no inverse.
  [[nodiscard]] Eigen::Vector2d toImage(double x, double y) const;
  //! Size of a pixel on the product, um, along u; equals the mean over the image except for distortion.
  [[nodiscard]] double pixelSizeUm() const { return 1e6 / scaleX; }
  //! #kappa1 per square metre of product, as in table 7.4 (there um^-2: times 1e-12).
  [[nodiscard]] double kappa1PerSquareMetre() const { return kappa1 * scaleX * scaleX; }

  /*!
   * ViSP camera one metre away from the product: its normalised coordinates are metres on the product, relative to the
   * principal point, without rotation or tilt. `kdu` is exact (vpPixelMeterConversion agrees with toPlane()); `kud`, a
   * different model, agrees with it at the corner of the image farthest from the principal point.
   */
  [[nodiscard]] vpCameraParameters toCamera() const;
  //! Calibration from such a camera; rotation and translation are zero.
  //! \throw vpException (badValue) naming a scale that is not > 0.
  [[nodiscard]] static vpMicroscopeCalibration fromCamera(const vpCameraParameters &camera, unsigned int width,
                                                          unsigned int height);
  /*!
   * Write toCamera() as ViSP's camera file. Rotation, translation, mirroring and tilt are not part of that file.
   * \param file : Must not exist, because ViSP would append to it. \param name : Name of the camera in the file.
   * ViSP reports on std::cout and std::cerr, which are muted meanwhile: not thread-safe.
   * \throw vpException (ioError) naming the file.
   */
  void saveXml(const std::string &file, const std::string &name = "microscope") const;
  /*!
   * Read a camera with distortion from ViSP's camera file. Not thread-safe, like saveXml().
   * \param file : ViSP's camera file. \param name : Name of the camera in it.
   * \param width, height : Size of the images, px.
   * \throw vpException (ioError) naming the file and the camera when the file has none for this size.
   */
  [[nodiscard]] static vpMicroscopeCalibration loadXml(const std::string &file, const std::string &name,
                                                       unsigned int width, unsigned int height);
};

END_VISP_NAMESPACE
#endif
