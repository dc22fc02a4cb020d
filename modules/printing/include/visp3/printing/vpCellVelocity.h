/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCellVelocity.h
 * \brief Velocity of a product from the cells that two frames have in common.
 */
#ifndef vpCellVelocity_h
#define vpCellVelocity_h

#include <visp3/pattern/vpPatternFrame.h>

#include <cstddef>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief Velocity of the product between two frames.
struct VISP_EXPORT vpCellVelocity {
  int cells = 0;      //!< Cells that were measured in both frames; 0: nothing below holds.
  double vx = 0.;     //!< To the right, px/frame.
  double vy = 0.;     //!< Down, px/frame.
  double sigmaX = 0.; //!< Standard deviation of vx if the errors of the cells are independent, px/frame.
  double sigmaY = 0.; //!< The same of vy, px/frame.
};

/*!
 * \ingroup group_printing
 * \brief Thesis (7.27), corrected: the mean displacement of the cells that are valid in \e both frames, by identity, each
 * weighted by the variance of its displacement. As printed, the sum runs over the cells of one frame and jumps by a
 * pitch when a cell enters or leaves.
 *
 * \param before, beforeCount : Cells of the earlier frame. Those with numbers that are not finite, beyond vpPrintingLargest
 * or, as deviations, not > 0 do not count.
 * \param now, nowCount : Cells of the later frame, of the same epoch.
 * \param frames : Frames between them, 1e-12 to 1e12; otherwise no cell counts. 2 after a dropped frame.
 * \return See vpCellVelocity. In lists sorted alike each common cell takes constant time; a cell without counterpart costs a look
 * at all earlier ones, so the work is at most that of beforeCount nowCount comparisons. Does not allocate.
 */
[[nodiscard]] VISP_EXPORT vpCellVelocity vpFindCellVelocity(const vpPatternCell *before, std::size_t beforeCount,
                                                            const vpPatternCell *now, std::size_t nowCount,
                                                            double frames = 1.) noexcept;

END_VISP_NAMESPACE
#endif
