/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A pattern in closed form for the tests: rectangles blurred by a Gaussian are products of error functions.
#ifndef vpAnalyticPattern_h
#define vpAnalyticPattern_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace vpPatternTest
{
VISP_DIRECT_USING_NAMESPACE

struct Pattern {
  unsigned int width = 160, height = 100;
  double pitchX = 48.9, pitchY = 17.8, cellX = 39.6, cellY = 11.6, blur = 0.85;
  double dark = 60., bright = 170., noise = 4., slope = 0.,
         slopeY = 0.;      // shares by which the light falls off to each side across the image
  double jitter = 0.;      // px, fixed for each cell
  double x = 20., y = 12.; // centre of cell (0, 0)
  double rotation = 0.;    // rad, about that centre; of the images only

  // Deviation of a cell from its lattice position, reproducible.
  double deviation(int row, int column, int axis) const
  {
    const double h = std::sin(12.9898 * row + 78.233 * column + 37.719 * axis) * 43758.5453;
    return jitter * (2. * (h - std::floor(h)) - 1.);
  }
  double cellPositionX(int row, int column) const { return x + column * pitchX + deviation(row, column, 0); }
  double cellPositionY(int row, int column) const { return y + row * pitchY + deviation(row, column, 1); }

  // Its centre in the image.
  double centreX(int row, int column) const
  {
    const double du = cellPositionX(row, column) - x, dv = cellPositionY(row, column) - y;
    return x + std::cos(rotation) * du - std::sin(rotation) * dv;
  }
  double centreY(int row, int column) const
  {
    const double du = cellPositionX(row, column) - x, dv = cellPositionY(row, column) - y;
    return y + std::sin(rotation) * du + std::cos(rotation) * dv;
  }

  double edge(double u) const { return 0.5 * std::erf(u / (std::sqrt(2.) * blur)); }
  double value(double u, double v) const
  {
    const double light = 1. + slope * (u / (width - 1.) - 0.5) * 2. + slopeY * (v / (height - 1.) - 0.5) * 2.;
    if (rotation != 0.) {
      const double du = u - x, dv = v - y;
      u = x + std::cos(rotation) * du + std::sin(rotation) * dv;
      v = y - std::sin(rotation) * du + std::cos(rotation) * dv;
    }
    const int column = static_cast<int>(std::lround((u - x) / pitchX)),
              row = static_cast<int>(std::lround((v - y) / pitchY));
    const double du = u - cellPositionX(row, column), dv = v - cellPositionY(row, column);
    const double inside =
        (edge(du + 0.5 * cellX) - edge(du - 0.5 * cellX)) * (edge(dv + 0.5 * cellY) - edge(dv - 0.5 * cellY));
    return (dark + (bright - dark) * inside) * light;
  }
  double sigma(double value) const { return noise * std::sqrt(0.36 + value / 157.); }

  void render(std::mt19937_64 &rng, vpImage<unsigned char> &image) const
  {
    image.resize(height, width);
    std::normal_distribution<double> normal;
    for (unsigned int v = 0; v < height; ++v) {
      for (unsigned int u = 0; u < width; ++u) {
        const double mean = value(u, v);
        image[v][u] = static_cast<unsigned char>(std::clamp(std::lround(mean + sigma(mean) * normal(rng)), 0L, 255L));
      }
    }
  }

  // Cramer-Rao bound of one cell: no unbiased method has smaller deviations.
  void bound(double &sigmaX, double &sigmaY) const
  {
    double xx = 0., yy = 0.;
    const double step = 0.01;
    for (double v = -0.5 * pitchY; v < 0.5 * pitchY; v += 1.) {
      for (double u = -0.5 * pitchX; u < 0.5 * pitchX; u += 1.) {
        const double gx = (value(x + u + step, y + v) - value(x + u - step, y + v)) / (2. * step);
        const double gy = (value(x + u, y + v + step) - value(x + u, y + v - step)) / (2. * step);
        const double s = sigma(value(x + u, y + v));
        xx += gx * gx / (s * s);
        yy += gy * gy / (s * s);
      }
    }
    sigmaX = 1. / std::sqrt(xx);
    sigmaY = 1. / std::sqrt(yy);
  }
};
} // namespace vpPatternTest

#endif
