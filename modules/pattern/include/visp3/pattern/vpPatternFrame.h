/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPatternFrame.h
 * \brief What one image says about a repetitive pattern: cells, motion, lattice, status.
 *
 * Pixel coordinates: x to the right, y down, (0, 0) is the centre of the top left pixel.
 */
#ifndef vpPatternFrame_h
#define vpPatternFrame_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <limits>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_pattern
//! \brief How far the result can be relied upon.
enum class vpPatternStatus {
  Acquiring, //!< Looking for the pattern, or learning its template; cells that are valid are measured by their edges.
  Tracking,  //!< Locked: identities, centres and displacement hold.
  Degraded,  //!< Locked, but see the reason: fewer cells than there should be, or identities that started anew.
  Lost       //!< No lock in this image; nothing in it is valid.
};

//! \ingroup group_pattern
//! \brief Why the status is not Tracking.
enum class vpPatternReason {
  None,            //!< Nothing to say.
  WrongSize,       //!< The image has not the size that the tracker was made for.
  NoContrast,      //!< The image has one grey value, or two that are nearly the same.
  NoCells,         //!< No spots of equal size.
  TooMuchNoise,    //!< More spots than a pattern can have.
  NoLattice,       //!< Spots, but not two periods of a lattice each way (a pattern coarser than the view).
  CellTooSmall,    //!< The cells or their pitch are below the least size.
  Learning,        //!< The lattice is known, the template is being learned.
  CellsMissing,    //!< Less than half of the cells that should be seen are valid.
  AmbiguousMotion, //!< The motion is near or above half a pitch: identities started anew.
  IdentitySlip,    //!< The cells do not deviate from the lattice as before: identities started anew.
  Restarted,       //!< Found again after too many frames: identities started anew.
  NoMatch,         //!< The image does not show the pattern where it can be.
  ImagesMissing,   //!< vpPatternTracker::interrupt(): identities started anew.
  SingleRow,       //!< Instead of NoLattice: all spots are on one line.
  TurnedTooFar     //!< Instead of NoLattice: rows that are turned by more than 30 degrees.
};

//! \ingroup group_pattern
//! \brief One cell of the pattern.
struct VISP_EXPORT vpPatternCell {
  int row = 0;    //!< Row, counted downwards; stays with the cell while it moves, within one epoch.
  int column = 0; //!< Column, counted to the right; as row.
  double x = 0.;  //!< Centre, px to the right. For an invalid cell: where it should be.
  double y = 0.;  //!< Centre, px down.
  double sigmaX =
      std::numeric_limits<double>::infinity(); //!< Standard deviation of x, px, from the noise of this image.
  double sigmaY = std::numeric_limits<double>::infinity(); //!< Standard deviation of y, px.
  double deviationX = 0.; //!< How far the cell is off its place in the regular lattice, px; smoothed over the frames.
  double deviationY = 0.; //!< As deviationX, down.
  bool valid = false;     //!< The centre was measured in this image.
};

//! \ingroup group_pattern
//! \brief The regular lattice: cell (row, column) is near origin + column * columnPitch + row * rowPitch.
struct VISP_EXPORT vpPatternLattice {
  double originX = 0.;      //!< Where cell (0, 0) of the lattice would be, px. May be far outside the image.
  double originY = 0.;      //!< As originX.
  double columnPitchX = 0.; //!< Vector from a cell to the next column, px.
  double columnPitchY = 0.; //!< As columnPitchX.
  double rowPitchX = 0.;    //!< Vector from a cell to the next row, px.
  double rowPitchY = 0.;    //!< As rowPitchX.

  //! Length of the vector between columns, px; 0 before the first acquisition.
  [[nodiscard]] double columnPitch() const;
  //! Length of the vector between rows, px; 0 before the first acquisition.
  [[nodiscard]] double rowPitch() const;
  //! Direction of the rows in the image, rad, positive from x towards y.
  [[nodiscard]] double angle() const;
};

/*!
 * \ingroup group_pattern
 * \brief Everything about one image. The storage belongs to the tracker and is used again for the next image.
 */
struct VISP_EXPORT vpPatternFrame {
  vpPatternStatus status = vpPatternStatus::Acquiring; //!< How far to rely on the rest.
  vpPatternReason reason = vpPatternReason::None;      //!< Why the status is not Tracking.
  unsigned int index = 0;                              //!< Number of the image, from 0.
  unsigned int epoch = 0; //!< Goes up when the identities start anew; rows and columns of two epochs do not compare.
  std::vector<vpPatternCell> cells; //!< All cells that lie completely in view, valid or not, row by row.
  int validCells = 0;               //!< Number of valid cells.
  bool hasMotion = false;           //!< dx and dy hold: cells were matched with the image before.
  double dx = 0.;                   //!< Displacement since the image before, px to the right.
  double dy = 0.;                   //!< Displacement, px down.
  double sigmaDx = std::numeric_limits<double>::infinity(); //!< Standard deviation of dx, px.
  double sigmaDy = std::numeric_limits<double>::infinity(); //!< Standard deviation of dy, px.
  vpPatternLattice lattice;                                 //!< The regular lattice in this image.
  unsigned int templates = 0; //!< Templates so far: 1 once it is learned, one more each time it was learned anew.
  double noise = 0.;          //!< Standard deviation of the grey values about the template, grey values.

  //! The status in a sentence, such as "Lost: the image has no contrast." Static text, never null.
  [[nodiscard]] const char *message() const;
};

//! \ingroup group_pattern
//! \brief The status as a word ("Tracking"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpPatternStatus status);

END_VISP_NAMESPACE
#endif
