/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDotLattice.h
 * \brief The lattice behind the dots of one image, of any kind and direction.
 */
#ifndef vpDotLattice_h
#define vpDotLattice_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <visp3/core/vpImage.h>

#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_pattern
//! \brief How many directions the dots repeat in.
enum class vpDotLatticeKind {
  None, //!< No lattice was found; vpDotLattice::message says why.
  Row,  //!< One row of dots.
  Plane //!< Rows and columns.
};

//! \ingroup group_pattern
//! \brief One dot on the lattice.
struct VISP_EXPORT vpLatticeDot {
  double x = 0.;  //!< Centre by half-maximum edges, px to the right.
  double y = 0.;  //!< px down.
  int column = 0; //!< Steps along vpDotLattice::ax, ay; 0 is near the middle of the dots.
  int row = 0;    //!< Steps along vpDotLattice::bx, by.
};

/*!
 * \ingroup group_pattern
 * \brief What vpFindDotLattice() answers.
 *
 * (ax, ay) and (bx, by) are the two shortest steps from dot to dot at the middle of the image (a reduced basis), px. a
 * points most nearly to the right, b is on its clockwise side as seen; the angle between them lies in [60, 120] degrees
 * but for perspective. Of a lattice with several dots in each period, one of them stands for the period.
 */
struct VISP_EXPORT vpDotLattice {
  vpDotLatticeKind kind = vpDotLatticeKind::None; //!< Row, plane or none.
  double ax = 0.;                                 //!< Step from column to column, px to the right.
  double ay = 0.;                                 //!< px down.
  double bx = 0.;                                 //!< Step from row to row, px to the right; 0 for one row.
  double by = 0.;                                 //!< px down.
  std::vector<vpLatticeDot> dots;                 //!< Those on the lattice.
  int spots = 0;                                  //!< Spots of like size that were seen, on the lattice or not.
  bool bright = false;                            //!< The dots are brighter than what is around them.
  double rms = 0.;                                //!< Distance of the dots from a lattice bent to second order, px.
  double occupancy = 0.;                          //!< Share of the steps to the next place that meet a dot, in [0, 1].
  std::string message;                            //!< Why there is none, or what was found, in a sentence.

  //! Between a and b, degrees in (0, 180); NaN for one row.
  [[nodiscard]] double angle() const;
  //! Length of a and of b, px.
  [[nodiscard]] double columnPitch() const;
  //! \copydoc columnPitch()
  [[nodiscard]] double rowPitch() const;
  //! "square", "rectangular", "hexagonal", "centred rectangular", "oblique" or "row", to 3 % and 2 degrees.
  [[nodiscard]] const char *name() const;
};

/*!
 * \ingroup group_pattern
 * Find the dots and their lattice: square, rectangular, hexagonal, centred (quincunx), oblique, honeycomb (half of its
 * dots) or one row; turned by any angle; of either polarity and of several grey levels; under uneven light, in perspective
 * up to about 1 : 1.6 over the view, with missing dots and strangers among them.
 *
 * Spots are what differs from local levels (mean, deviation and skewness of a window, tried at several sizes). A lattice
 * vector is a difference that spots share more often than chance; of all bases of such vectors the one whose walk from
 * dot to dot reaches most dots wins. At least 30 % of the spots must lie on it, within a tenth of the pitch,
 * and more than random spots would (probability 1e-6): nine dots that fit well, or more that fit badly.
 * The effort is bounded: so many passes over the image as there are window sizes (four), and at most 20000 spots.
 * \param image : 8 bit, at least 16 x 16 px.
 * \throw vpException (badValue) when the image is smaller than that.
 */
[[nodiscard]] VISP_EXPORT vpDotLattice vpFindDotLattice(const vpImage<unsigned char> &image);

END_VISP_NAMESPACE
#endif
