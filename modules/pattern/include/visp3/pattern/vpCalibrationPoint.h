/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCalibrationPoint.h
 * \brief Points for the calibrations: measured image position and known object position.
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
 * \brief A point known on the product or on a calibration grid, and measured in an image.
 *
 * Pixels: u to the right, v down, (0, 0) is the centre of the top left pixel. Object coordinates are metres.
 */
struct VISP_EXPORT vpCalibrationPoint {
  double u = 0.;          //!< Measured image position, px to the right.
  double v = 0.;          //!< Measured image position, px down.
  double x = 0.;          //!< Object coordinate, m.
  double y = 0.;          //!< Object coordinate, m.
  double z = 0.;          //!< Object coordinate, m; vpPlanarMicroscopeCalibration requires a plane z = 0.
  double sigmaU = 1.;     //!< Standard deviation of u, px, > 0.
  double sigmaV = 1.;     //!< Standard deviation of v, px, > 0.
  double sigmaPlane = 0.; //!< Standard deviation of x and of y (manufacturing tolerance), m, >= 0.
};

//! \ingroup group_pattern
//! \brief The product or the grid as a ruler: the pitches of its cells.
struct VISP_EXPORT vpCalibrationPitch {
  double columns = 0.;    //!< Distance between neighbouring columns, m, > 0.
  double rows = 0.;       //!< Distance between neighbouring rows, m, > 0.
  double sigmaPlane = 0.; //!< Standard deviation of the position of a cell, per axis, m, >= 0.
  //! Angle from the columns' direction to the rows', rad, in [0.5, 2.7]: pi/2 for a rectangular lattice, pi/3 for a
  //! hexagonal one. NaN: hexagonal where the lattice is and #columns and #rows are equal, otherwise
  //! rectangular.
  double angle = std::numeric_limits<double>::quiet_NaN();

  //! \throw vpException (badValue) naming the field and its value.
  void check() const;
};

/*!
 * \ingroup group_pattern
 * The valid cells of a frame as lattice points: x = column * columns + row * rows * cos(angle),
 * y = row * rows * sin(angle), z = 0.
 *
 * The columns are those that vpPatternTracker counts to the right in the image and the rows those that it counts
 * downwards, so a product rotated by a quarter turn has its pitches exchanged. The standard deviations are those of the
 * cells; 0.1 px where the tracker does not know them, as in its first image: then set
 * vpMicroscopeCalibrationSpec::sigmaFromResiduals.
 * \throw vpException (badValue) naming a pitch that is not > 0.
 */
[[nodiscard]] VISP_EXPORT std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpPatternFrame &frame,
                                                                              const vpCalibrationPitch &pitch);

/*!
 * \ingroup group_pattern
 * The dots of a lattice as calibration points. Of all bases of the lattice the most similar to the pitch is used, and
 * among equals the one whose columns are nearest to the right direction. The standard deviations are 0.1 px: set
 * sigmaFromResiduals of the calibration.
 * \param lattice : Result of vpFindDotLattice(). \param pitch : Pitch of the grid.
 * \throw vpException (badValue) naming a pitch that is not > 0; (fatalError) with the lattice's message when there is
 *   no lattice, or only one row.
 */
[[nodiscard]] VISP_EXPORT std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpDotLattice &lattice,
                                                                              const vpCalibrationPitch &pitch);

/*!
 * \ingroup group_pattern
 * The dots found by vpFindDotLattice() in an image as calibration points.
 * \param image : 8 bit, at least 16 x 16 px. \param pitch : Pitch of the grid.
 * \throw vpException as the other overloads, and as vpFindDotLattice().
 */
[[nodiscard]] VISP_EXPORT std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpImage<unsigned char> &image,
                                                                              const vpCalibrationPitch &pitch);

END_VISP_NAMESPACE
#endif
