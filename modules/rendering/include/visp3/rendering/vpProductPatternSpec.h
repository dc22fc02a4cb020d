/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProductPatternSpec.h
 * \brief Appearance of a repetitive, flexible product under a camera.
 */
#ifndef vpProductPatternSpec_h
#define vpProductPatternSpec_h

#include <visp3/direct_core/vpField.h>

#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_rendering
//! \brief Outline of a cell's opening.
enum class vpProductShape {
  Rectangle, //!< Sharp corners.
  Rounded,   //!< Corners are quarter circles.
  Dot        //!< Ellipse, a circle if both sizes are equal.
};

//! \ingroup group_rendering
//! \return "rectangle", "rounded" or "dot".
[[nodiscard]] VISP_EXPORT std::string vpToString(vpProductShape shape);

/*!
 * \ingroup group_rendering
 * \brief Parameters of a vpProductPattern. The defaults are the display of thesis chapter 7: openings of 178 x 52 um
 * at a pitch of 220 x 80 um, imaged at 4.5 um per pixel; with the noise of a good camera and without defects.
 *
 * Lengths are in image px, angles in rad, grey values 0..255. x is along the image's rows (u), y along its columns (v),
 * both rotated by #rotation for pitch, opening, jitter and flexible pitch.
 */
struct VISP_EXPORT vpProductPatternSpec {
  unsigned int width = 160;  //!< Columns of the image, px, 8..16384.
  unsigned int height = 100; //!< Rows of the image, px, 8..16384.
  double pixelSize = 4.5;    //!< Size of a pixel on the product, for reports only, um, > 0.

  double pitchX = 220. / 4.5;      //!< Pitch of the cells along a row, px, 2..100000.
  double pitchY = 80. / 4.5;       //!< Pitch of the rows, px, 2..100000.
  double openingX = 178. / 4.5;    //!< Length of an opening along its row, px, 1..1024. See validate().
  double openingY = 52. / 4.5;     //!< Length of an opening across its row, px, 1..1024. See validate().
  double cornerRadius = 20. / 4.5; //!< Corner radius of a rounded opening, px, 0..512. At most half the shorter length.
  vpProductShape shape = vpProductShape::Rounded; //!< Outline of the openings.
  double rotation = 0.; //!< Rotation of the product in the image, from x to y (clockwise as displayed), rad, -pi..pi.

  double dark = 60.;         //!< Grey value between the openings, 0..255.
  double bright = 170.;      //!< Grey value of the openings, 0..255. Below #dark for dark cells on bright ground.
  double illuminationX = 0.; //!< Illumination gradient along u: factor 1 - x at the left, 1 + x at the right, -1..1.
  double illuminationY = 0.; //!< Illumination gradient along v: 1 - y at the top, 1 + y at the bottom, -1..1.

  double psf = 0.8;  //!< Standard deviation of the Gaussian blur of the optics, px, 0..5. The pixel area adds to it.
  double noise = 1.; //!< Noise scale ns: variance = ns^2 (0.6^2 + I / 157) at the grey value I, 0..50.
  double exposure = 0.08; //!< Exposure time as a fraction of the frame period, 0..1.

  double jitter = 0.; //!< Standard deviation of a cell's position per axis, px, 0..100000. Cut at three times that.
  double flexAmplitudeX = 0.; //!< Flexible pitch: amplitude of the displacement along the rows, px, 0..100000.
  double flexAmplitudeY = 0.; //!< Flexible pitch: amplitude of the displacement across the rows, px, 0..100000.
  double flexPeriodX = 20.;   //!< Period of the sinusoidal displacement over the columns, cells, 4..1000000.
  double flexPeriodY = 20.;   //!< Period of the sinusoidal displacement over the rows, cells, 4..1000000.

  double dust = 0.;    //!< Dark specks, 2 to 8 px wide, per 100 x 100 px of product, on average, 0..100.
  double cracks = 0.;  //!< Dark crooked lines, 20 to 70 px long, per 100 x 100 px, on average, 0..100.
  double missing = 0.; //!< Fraction of cells without an opening, 0..1.
  double damaged = 0.; //!< Fraction of cells that are partly closed, 0..1. #missing + damaged <= 1.

  unsigned int seed = 1; //!< Seed of product and noise, >= 0.

  //! The numbers with their ranges and units, except #rotation.
  [[nodiscard]] static const vpFields<vpProductPatternSpec> &fields();
  /*!
   * Checks the ranges above; |#illuminationX| + |#illuminationY| must be below 1. Openings must also not touch:
   * opening <= pitch - 6 jitter - the largest reduction by the flexible pitch, 2 amplitude sin(pi / period); in x and
   * in y.
   * \throw vpException (badValue) naming the field and its value.
   */
  void validate() const;
};

END_VISP_NAMESPACE
#endif
