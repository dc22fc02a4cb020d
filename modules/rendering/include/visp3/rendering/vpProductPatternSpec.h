/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProductPatternSpec.h
 * \brief What a repetitive, flexible product looks like under a camera.
 */
#ifndef vpProductPatternSpec_h
#define vpProductPatternSpec_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_rendering
//! \brief Outline of a cell's opening.
enum class vpProductShape {
  Rectangle, //!< Sharp corners.
  Rounded,   //!< Corners are quarters of a circle.
  Dot        //!< Ellipse, a circle where both sizes are the same.
};

//! \ingroup group_rendering
//! \return "rectangle", "rounded" or "dot".
[[nodiscard]] VISP_EXPORT std::string toString(vpProductShape shape);

/*!
 * \ingroup group_rendering
 * \brief Parameters of a vpProductPattern. The defaults are the display of thesis chapter 7: openings of 178 x 52 um
 * every 220 x 80 um, seen with 4.5 um a pixel; without noise or defects beyond those of a good camera.
 *
 * Lengths are px of the image, angles rad, grey values 0..255. x is along the image's rows (u), y along its columns (v),
 * both turned by #rotation for pitch, opening, jitter and flexible pitch.
 */
struct VISP_EXPORT vpProductPatternSpec {
  unsigned int width = 160;  //!< Columns of the image, px, 8..16384.
  unsigned int height = 100; //!< Rows of the image, px, 8..16384.
  double pixelSize = 4.5;    //!< Size of a pixel on the product, um, > 0. For reports; it changes no picture.

  double pitchX = 220. / 4.5;      //!< From cell to cell along a row, px, 2..100000.
  double pitchY = 80. / 4.5;       //!< From row to row, px, 2..100000.
  double openingX = 178. / 4.5;    //!< Length of an opening along its row, px, 1..1024, see validate().
  double openingY = 52. / 4.5;     //!< Length of an opening across its row, px, 1..1024, see validate().
  double cornerRadius = 20. / 4.5; //!< Of vpProductShape::Rounded, px, 0..half of the shorter length; else unused.
  vpProductShape shape = vpProductShape::Rounded; //!< Outline of the openings.
  double rotation = 0.; //!< Of the product in the image, from x to y (clockwise as seen), rad, -pi..pi.

  double dark = 60.;         //!< Grey value between the openings, 0..255.
  double bright = 170.;      //!< Grey value of the openings, 0..255; below #dark for dark cells on bright ground.
  double illuminationX = 0.; //!< Light falls off along u: by this share at the left, more by it at the right, -1..1.
  double illuminationY = 0.; //!< The same along v, from the top to the bottom; |x| + |y| < 1.

  double psf = 0.8;  //!< Standard deviation of the Gaussian blur of the optics, px, 0..5. A pixel's area comes on top.
  double noise = 1.; //!< Noise scale ns: variance = ns^2 (0.6^2 + I / 157) DN^2 at the grey value I; 0..50.
  double exposure = 0.08; //!< Share of the time between two frames in which the camera sees the motion, 0..1.

  double jitter = 0.; //!< Standard deviation of a cell's place, each axis, px, >= 0; cut off at three times that.
  double flexAmplitudeX = 0.; //!< Flexible pitch: cells lie up to this far before or behind their place, px, >= 0.
  double flexAmplitudeY = 0.; //!< The same across the rows.
  double flexPeriodX = 20.;   //!< The place varies with the column as a sine of this period, cells, >= 4.
  double flexPeriodY = 20.;   //!< The same with the row.

  double dust = 0.;    //!< Dark specks, 2 to 8 px wide, per 100 x 100 px of product, on average; 0..100.
  double cracks = 0.;  //!< Dark crooked lines, 20 to 70 px long, per 100 x 100 px, on average; 0..100.
  double missing = 0.; //!< Share of cells without an opening, 0..1.
  double damaged = 0.; //!< Share of cells of which a part is closed, 0..1; #missing + damaged <= 1.

  unsigned int seed = 1; //!< Of everything random: another seed is another product and another noise.

  /*!
   * Check the ranges above. In addition openings must not touch: opening <= pitch - 6 jitter - the most that the
   * flexible pitch takes away, 2 amplitude sin(pi / period); in x and in y.
   * \throw vpException (badValue) naming the field and its value.
   */
  void validate() const;
};

END_VISP_NAMESPACE
#endif
