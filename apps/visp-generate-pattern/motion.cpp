/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "motion.h"

#include <cmath>

namespace generatePattern
{
Pair Motion::placeAt(double frame) const
{
  const double sine = std::sin(2. * M_PI * frame / period);
  return {{start[0] + velocity[0] * frame + swing[0] * sine, start[1] + velocity[1] * frame + swing[1] * sine}};
}

Pair Motion::velocityAt(double frame) const
{
  const double slope = 2. * M_PI / period * std::cos(2. * M_PI * frame / period);
  return {{velocity[0] + swing[0] * slope, velocity[1] + swing[1] * slope}};
}
} // namespace generatePattern
