/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPatternFrame.h
 * \brief Result of one image of a repetitive pattern: cells, motion, lattice, status.
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
//! \brief Reliability of the result.
enum class vpPatternStatus {
  Acquiring, //!< Searching for the pattern, or learning its template; valid cells are measured by their edges.
  Tracking,  //!< Locked: identities, centres and displacement are valid.
  Degraded,  //!< Locked, with a restriction given by the reason: fewer cells than expected, or restarted identities.
  Lost       //!< No lock in this image; nothing in it is valid.
};

//! \ingroup group_pattern
//! \brief Why the status is not Tracking.
enum class vpPatternReason {
  None,            //!< No remark.
  WrongSize,       //!< The size of the image is not that given to the tracker.
  NoContrast,      //!< The image has a single grey value, or two nearly equal ones.
  NoCells,         //!< No spots of equal size.
  TooMuchNoise,    //!< More spots than a pattern can have.
  NoLattice,       //!< Spots, but not two periods of a lattice in both directions (a pattern coarser than the view).
  CellTooSmall,    //!< The cells or their pitch are below the minimum size.
  Learning,        //!< The lattice is known, the template is being learned.
  CellsMissing,    //!< Less than half of the cells that should be seen are valid.
  AmbiguousMotion, //!< The motion is near or above half a pitch: identities restarted.
  IdentitySlip,    //!< The cells do not deviate from the lattice as before: identities restarted.
  Restarted,       //!< Found again after too many frames: identities restarted.
  NoMatch,         //!< The image does not show the pattern where it is expected.
  ImagesMissing,   //!< vpPatternTracker::interrupt(): identities restarted.
  SingleRow,       //!< Instead of NoLattice: all spots are on one line.
  TurnedTooFar     //!< Instead of NoLattice: rows that are turned by more than 30 degrees.
};

//! \ingroup group_pattern
//! \brief One cell of the pattern.
struct VISP_EXPORT vpPatternCell {
  int row = 0;    //!< Row index, increasing downwards; constant for a moving cell within one epoch.
  int column = 0; //!< Column index, increasing to the right; constant like #row.
  double x = 0.;  //!< Centre, px to the right. For an invalid cell: the predicted one.
  double y = 0.;  //!< Centre, px down.
  double sigmaX = std::numeric_limits<double>::infinity(); //!< Standard deviation of x, px, from this image's noise.
  double sigmaY = std::numeric_limits<double>::infinity(); //!< Standard deviation of y, px.
  double deviationX = 0.; //!< Deviation of the cell from the regular lattice, px to the right; smoothed over frames.
  double deviationY = 0.; //!< Deviation of the cell from the regular lattice, px down.
  bool valid = false;     //!< The centre was measured in this image.
};

//! \ingroup group_pattern
//! \brief The regular lattice: cell (row, column) is near origin + column * columnPitch + row * rowPitch.
struct VISP_EXPORT vpPatternLattice {
  double originX = 0.;      //!< Position of cell (0, 0) of the lattice, px to the right. May be far outside the image.
  double originY = 0.;      //!< Position of cell (0, 0) of the lattice, px down.
  double columnPitchX = 0.; //!< Vector from a cell to the next column, px to the right.
  double columnPitchY = 0.; //!< Vector from a cell to the next column, px down.
  double rowPitchX = 0.;    //!< Vector from a cell to the next row, px to the right.
  double rowPitchY = 0.;    //!< Vector from a cell to the next row, px down.

  //! Length of the vector between columns, px; 0 before the first acquisition.
  [[nodiscard]] double columnPitch() const;
  //! Length of the vector between rows, px; 0 before the first acquisition.
  [[nodiscard]] double rowPitch() const;
  //! Direction of the rows in the image, rad, positive from x towards y.
  [[nodiscard]] double angle() const;
};

/*!
 * \ingroup group_pattern
 * \brief Result of one image. The storage belongs to the tracker and is reused for the next image.
 */
struct VISP_EXPORT vpPatternFrame {
  vpPatternStatus status = vpPatternStatus::Acquiring; //!< Reliability of the result.
  vpPatternReason reason = vpPatternReason::None;      //!< Why the status is not Tracking.
  unsigned int index = 0;                              //!< Number of the image, from 0.
  unsigned int epoch = 0; //!< Incremented when identities restart; rows and columns of different epochs do not match.
  std::vector<vpPatternCell> cells; //!< All cells completely in view, valid or not, row by row.
  int validCells = 0;               //!< Number of valid cells.
  bool hasMotion = false;           //!< dx and dy are valid: cells were matched with the previous image.
  double dx = 0.;                   //!< Displacement since the previous image, px to the right.
  double dy = 0.;                   //!< Displacement since the previous image, px down.
  double sigmaDx = std::numeric_limits<double>::infinity(); //!< Standard deviation of dx, px.
  double sigmaDy = std::numeric_limits<double>::infinity(); //!< Standard deviation of dy, px.
  vpPatternLattice lattice;                                 //!< The regular lattice in this image.
  unsigned int templates = 0; //!< Number of templates: 1 once the first is learned, one more each time it is relearned.
  double noise = 0.;          //!< Standard deviation of the grey values about the template, grey values.

  //! Status as a sentence, such as "Lost: the image has no contrast." Static text, never null.
  [[nodiscard]] const char *message() const;
};

//! \ingroup group_pattern
//! \brief Status as a word ("Tracking"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpPatternStatus status);

END_VISP_NAMESPACE
#endif
