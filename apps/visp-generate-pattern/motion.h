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
#include <cmath>

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

inline Pair Motion::placeAt(double frame) const
{
  const double sine = std::sin(2. * M_PI * frame / period);
  return {{start[0] + velocity[0] * frame + swing[0] * sine, start[1] + velocity[1] * frame + swing[1] * sine}};
}

inline Pair Motion::velocityAt(double frame) const
{
  const double slope = 2. * M_PI / period * std::cos(2. * M_PI * frame / period);
  return {{velocity[0] + swing[0] * slope, velocity[1] + swing[1] * slope}};
}
} // namespace generatePattern

#endif
