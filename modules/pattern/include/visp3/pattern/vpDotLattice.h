/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDotLattice.h
 * \brief Finds the lattice of the dots in one image, of any kind and direction.
 */
#ifndef vpDotLattice_h
#define vpDotLattice_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <visp3/core/vpImage.h>

#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_pattern
//! \brief Number of directions in which the dots repeat.
enum class vpDotLatticeKind {
  None, //!< No lattice was found; vpDotLattice::message gives the reason.
  Row,  //!< One row of dots.
  Plane //!< Rows and columns.
};

//! \ingroup group_pattern
//! \brief One dot on the lattice.
struct VISP_EXPORT vpLatticeDot {
  double x = 0.;  //!< Centre by half-maximum edges, px to the right.
  double y = 0.;  //!< Centre, px down.
  int column = 0; //!< Index along vpDotLattice::ax, ay; 0 is near the middle of the dots.
  int row = 0;    //!< Index along vpDotLattice::bx, by.
};

/*!
 * \ingroup group_pattern
 * \brief Result of vpFindDotLattice().
 *
 * (ax, ay) and (bx, by) are the two shortest lattice vectors at the middle of the image (a reduced basis), px. a points
 * most nearly to the right, b is clockwise from it as seen; the angle between them lies in [60, 120] degrees except for
 * perspective. For a lattice with several dots per period, one of them represents the period.
 */
struct VISP_EXPORT vpDotLattice {
  vpDotLatticeKind kind = vpDotLatticeKind::None; //!< Row, plane or none.
  double ax = 0.;                                 //!< Step from column to column, px to the right.
  double ay = 0.;                                 //!< Step from column to column, px down.
  double bx = 0.;                                 //!< Step from row to row, px to the right; 0 for one row.
  double by = 0.;                                 //!< Step from row to row, px down.
  std::vector<vpLatticeDot> dots;                 //!< Dots on the lattice.
  int spots = 0;                                  //!< Number of similar-sized spots detected, on the lattice or not.
  bool bright = false;                            //!< The dots are brighter than their surroundings.
  double rms = 0.;                                //!< RMS distance of the dots from a second-order lattice, px.
  double occupancy = 0.;                          //!< Fraction of neighbouring lattice points with a dot, in [0, 1].
  std::string message;                            //!< Reason for no lattice, or a summary, in a sentence.

  //! Angle between a and b, degrees in (0, 180); NaN for one row.
  [[nodiscard]] double angle() const;
  //! Length of a, px.
  [[nodiscard]] double columnPitch() const;
  //! Length of b, px.
  [[nodiscard]] double rowPitch() const;
  //! Name: "square", "rectangular", "hexagonal", "centred rectangular", "oblique" or "row", to 3 % and 2 degrees.
  [[nodiscard]] const char *name() const;
};

/*!
 * \ingroup group_pattern
 * Find the dots and their lattice: square, rectangular, hexagonal, centred (quincunx), oblique, honeycomb (half of its
 * dots) or one row; rotated by any angle; of either polarity and of several grey levels; under uneven light, in
 * perspective up to about 1 : 1.6 over the view, with missing dots and outliers.
 *
 * Spots are pixels that differ from local levels (mean, deviation and skewness of a window, at several sizes). A
 * lattice vector is a difference that spots share more often than by chance; of all bases of such vectors the one whose
 * walk from dot to dot reaches most dots wins. At least 30 % of the spots must lie on it, within a tenth of the pitch,
 * and more than random spots would (probability 1e-6): nine dots that fit well, or more that fit badly. The effort is
 * bounded: one pass over the image per window size (four), and at most 20000 spots.
 *
 * \code
 * const vpDotLattice lattice = vpFindDotLattice(image);
 * std::cout << lattice.message << std::endl; // also why there is none
 * if (lattice.kind == vpDotLatticeKind::Plane) {
 *   std::cout << lattice.name() << ": " << lattice.dots.size() << " dots, pitches " << lattice.columnPitch() << " and "
 *             << lattice.rowPitch() << " px, " << lattice.rms << " px rms" << std::endl;
 * }
 * \endcode
 * \param image : 8 bit, at least 16 x 16 px.
 * \throw vpException (badValue) when the image is smaller.
 */
[[nodiscard]] VISP_EXPORT vpDotLattice vpFindDotLattice(const vpImage<unsigned char> &image);

END_VISP_NAMESPACE
#endif
