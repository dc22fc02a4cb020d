/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCalibrationPoint.h
 * \brief Points for the calibrations: where something is seen, and where it is.
 */
#ifndef vpCalibrationPoint_h
#define vpCalibrationPoint_h

#include <visp3/pattern/vpDotLattice.h>
#include <visp3/pattern/vpPatternFrame.h>

#include <visp3/core/vpImage.h>

#include <limits>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_pattern
 * \brief A point that is known on the product or on a calibration grid, and was measured in an image.
 *
 * Pixels: u to the right, v down, (0, 0) is the centre of the top left pixel. Object coordinates are metres.
 */
struct VISP_EXPORT vpCalibrationPoint {
  double u = 0.;          //!< Measured, px to the right.
  double v = 0.;          //!< Measured, px down.
  double x = 0.;          //!< On the object, m.
  double y = 0.;          //!< On the object, m.
  double z = 0.;          //!< On the object, m; vpPlanarMicroscopeCalibration wants one plane, z = 0.
  double sigmaU = 1.;     //!< Standard deviation of u, px, > 0.
  double sigmaV = 1.;     //!< Standard deviation of v, px, > 0.
  double sigmaPlane = 0.; //!< Standard deviation of x and of y (a product is not made exactly), m, >= 0.
};

//! \ingroup group_pattern
//! \brief The product or the grid as a ruler: how far its cells are from each other.
struct VISP_EXPORT vpCalibrationPitch {
  double columns = 0.;    //!< From a cell to its neighbour in the next column, m, > 0.
  double rows = 0.;       //!< From a cell to its neighbour in the next row, m, > 0.
  double sigmaPlane = 0.; //!< Standard deviation of the place of a cell, each axis, m, >= 0.
  //! From the columns' direction to the rows', rad, in [0.5, 2.7]: pi/2 for a rectangular lattice, pi/3 for a hexagonal
  //! one. NaN: as found, hexagonal where it is and #columns and #rows are the same, rectangular otherwise.
  double angle = std::numeric_limits<double>::quiet_NaN();

  //! \throw vpException (badValue) naming the field and its value.
  void check() const;
};

/*!
 * \ingroup group_pattern
 * The valid cells of a frame as points of the lattice: x = column * columns + row * rows * cos(angle),
 * y = row * rows * sin(angle), z = 0.
 *
 * The columns are those that vpPatternTracker counts to the right in the image and the rows those that it counts
 * downwards, so that a product that lies across shows its pitches exchanged. The standard deviations are the cells'
 * own; 0.1 px where the tracker does not know them, as in its first image: then set
 * vpMicroscopeCalibrationOptions::sigmaFromResiduals.
 * \throw vpException (badValue) naming a pitch that is not > 0.
 */
[[nodiscard]] VISP_EXPORT std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpPatternFrame &frame,
                                                                              const vpCalibrationPitch &pitch);

/*!
 * \ingroup group_pattern
 * The dots of a lattice as such points. Of all bases of the lattice the one that looks most like the pitch counts, and of
 * those that look alike the one whose columns go most nearly to the right. The standard deviations are 0.1 px: set
 * sigmaFromResiduals of the calibration.
 * \param lattice : Of vpFindDotLattice(). \param pitch : Of the grid.
 * \throw vpException (badValue) naming a pitch that is not > 0; (fatalError) with the lattice's sentence when there is none,
 * or only one row.
 */
[[nodiscard]] VISP_EXPORT std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpDotLattice &lattice,
                                                                              const vpCalibrationPitch &pitch);

/*!
 * \ingroup group_pattern
 * The same of the dots that vpFindDotLattice() finds in an image.
 * \param image : 8 bit, at least 16 x 16 px. \param pitch : Of the grid.
 * \throw vpException as the others, and as vpFindDotLattice().
 */
[[nodiscard]] VISP_EXPORT std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpImage<unsigned char> &image,
                                                                              const vpCalibrationPitch &pitch);

END_VISP_NAMESPACE
#endif
