/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFaintWall.h"

#include <visp3/core/vpUniRand.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

vpImage<unsigned char> vpFaintWall(unsigned int width, unsigned int height)
{
  constexpr int waves = 6;
  constexpr double amplitude = 8., grey = 128.;
  vpUniRand random(3);
  double du[waves], dv[waves], phase[waves];
  for (int k = 0; k < waves; ++k) {
    const double direction = random.uniform(0., 2. * M_PI), wavelength = random.uniform(80., 250.);
    du[k] = 2. * M_PI / wavelength * std::cos(direction);
    dv[k] = 2. * M_PI / wavelength * std::sin(direction);
    phase[k] = random.uniform(0., 2. * M_PI);
  }
  vpImage<unsigned char> image(height, width);
  for (unsigned int r = 0; r < height; ++r) {
    for (unsigned int c = 0; c < width; ++c) {
      double value = grey;
      for (int k = 0; k < waves; ++k) {
        value += amplitude * std::sin(du[k] * c + dv[k] * r + phase[k]);
      }
      image[r][c] = static_cast<unsigned char>(std::lround(value));
    }
  }
  return image;
}

END_VISP_NAMESPACE
