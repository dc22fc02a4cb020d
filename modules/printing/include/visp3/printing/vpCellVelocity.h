/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCellVelocity.h
 * \brief Velocity of a product from the cells visible in both of two frames.
 */
#ifndef vpCellVelocity_h
#define vpCellVelocity_h

#include <visp3/pattern/vpPatternFrame.h>

#include <cstddef>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief Velocity of the product between two frames.
struct VISP_EXPORT vpCellVelocity {
  int cells = 0;      //!< Cells measured in both frames; 0: the other members are invalid.
  double vx = 0.;     //!< To the right, px/frame.
  double vy = 0.;     //!< Down, px/frame.
  double sigmaX = 0.; //!< Standard deviation of vx if the errors of the cells are independent, px/frame.
  double sigmaY = 0.; //!< Standard deviation of vy if the errors of the cells are independent, px/frame.
};

/*!
 * \ingroup group_printing
 * \brief Thesis (7.27), corrected: the mean displacement of the cells that are valid in \e both frames, by identity,
 * each weighted by the variance of its displacement. As printed, the sum runs over the cells of one frame and jumps by
 * a pitch when a cell enters or leaves.
 *
 * \code
 * vpPatternTracker tracker(160, 100);
 * const std::vector<vpPatternCell> before = tracker.process(image).cells;
 * grabber.acquire(image);
 * const std::vector<vpPatternCell> &cells = tracker.process(image).cells;
 * const vpCellVelocity found = vpFindCellVelocity(before.data(), before.size(), cells.data(), cells.size());
 * if (found.cells > 0) {
 *   std::cout << found.vx << " +- " << found.sigmaX << " px/frame" << std::endl;
 * }
 * \endcode
 * \param before, beforeCount : Cells of the earlier frame. Cells with numbers that are not finite or beyond
 *   vpPrintingLargest, or with deviations not > 0, are ignored.
 * \param now, nowCount : Cells of the later frame, of the same epoch.
 * \param frames : Frames between them, 1e-12 to 1e12; otherwise all cells are ignored. 2 after a dropped frame.
 * \return See vpCellVelocity. In lists sorted alike each common cell takes constant time; a cell without counterpart is
 *   compared with all earlier ones, so at most beforeCount nowCount comparisons. Does not allocate.
 */
[[nodiscard]] VISP_EXPORT vpCellVelocity vpFindCellVelocity(const vpPatternCell *before, std::size_t beforeCount,
                                                            const vpPatternCell *now, std::size_t nowCount,
                                                            double frames = 1.) noexcept;

END_VISP_NAMESPACE
#endif
