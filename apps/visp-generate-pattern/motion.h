/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file motion.h
 * \brief Motion of the product in the sequence.
 */
#ifndef generatePattern_motion_h
#define generatePattern_motion_h

#include <array>

namespace generatePattern
{
using Pair = std::array<double, 2>; //!< x, y.

/*!
 * \brief Constant velocity and a sine: place(k) = start + velocity k + swing sin(2 pi k / period), k in frames.
 */
struct Motion {
  Pair start{{0., 0.}};    //!< Displacement in frame 0, px.
  Pair velocity{{5., 0.}}; //!< px/frame.
  Pair swing{{0., 0.}};    //!< Amplitude of the sine, px.
  double period = 50.;     //!< Period of the sine, frames, >= 2.

  //! Displacement of the product in a frame, px.
  [[nodiscard]] Pair placeAt(double frame) const;
  //! Velocity of the product in a frame, px/frame.
  [[nodiscard]] Pair velocityAt(double frame) const;
};
} // namespace generatePattern

#endif
