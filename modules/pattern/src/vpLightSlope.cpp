/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLightSlope.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

vpLightSlope::vpLightSlope(unsigned int width, unsigned int height, std::size_t maxCells)
  : m_middleX(0.5 * (width - 1.)), m_middleY(0.5 * (height - 1.))
{
  m_samples.reserve(2 * maxCells);
}

void vpLightSlope::clear()
{
  m_images = 0;
  m_slopeX = m_slopeY = 0.;
}

// Mean around a point, if all of it is in the image.
void vpLightSlope::add(const vpImage<unsigned char> &image, double x, double y, int halfWidth, int halfHeight)
{
  const int u = static_cast<int>(std::lround(x)), v = static_cast<int>(std::lround(y));
  const bool inside = u >= halfWidth && v >= halfHeight && u + halfWidth < static_cast<int>(image.getWidth()) &&
                      v + halfHeight < static_cast<int>(image.getHeight());
  if (!inside || m_samples.size() == m_samples.capacity()) {
    return;
  }
  int sum = 0;
  for (int row = v - halfHeight; row <= v + halfHeight; ++row) {
    const unsigned char *pixels = image[static_cast<unsigned int>(row)];
    for (int column = u - halfWidth; column <= u + halfWidth; ++column) {
      sum += pixels[column];
    }
  }
  const int count = (2 * halfWidth + 1) * (2 * halfHeight + 1);
  m_samples.push_back({u - m_middleX, v - m_middleY, static_cast<double>(sum) / count});
}

// Plane through the samples; those beyond two standard deviations, on dirt, are left out.
bool vpLightSlope::fit(Plane &plane) const
{
  constexpr int rounds = 3;
  constexpr double leastSpread = 4.; // px, each way: below it the slope is noise
  double limit = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Sample &s : m_samples) {
      if (std::abs(s.value - (plane.value + plane.slopeX * s.x + plane.slopeY * s.y)) <= limit) {
        const Eigen::Vector3d row(1., s.x, s.y);
        normal.noalias() += row * row.transpose();
        right += row * s.value;
      }
    }
    const double n = normal(0, 0);
    const double xx = normal(1, 1) - normal(0, 1) * normal(0, 1) / n,
                 xy = normal(1, 2) - normal(0, 1) * normal(0, 2) / n;
    const double yy = normal(2, 2) - normal(0, 2) * normal(0, 2) / n, least = n * leastSpread * leastSpread;
    if (n < 4. || !(xx > least) || !(yy > least) || !(xx * yy - xy * xy > 0.1 * xx * yy)) {
      return false;
    }
    const Eigen::Vector3d solution = normal.ldlt().solve(right);
    plane = {solution[0], solution[1], solution[2]};
    double squares = 0.;
    for (const Sample &s : m_samples) {
      const double residual = s.value - (plane.value + plane.slopeX * s.x + plane.slopeY * s.y);
      squares += std::abs(residual) <= limit ? residual * residual : 0.;
    }
    limit = std::max(1., 2. * std::sqrt(squares / n));
  }
  return true;
}

bool vpLightSlope::see(const vpImage<unsigned char> &image, const std::vector<vpPatternSpot> &spots,
                       const vpLattice &lattice)
{
  m_samples.clear();
  for (const vpPatternSpot &spot : spots) {
    add(image, spot.x, spot.y, std::max(1, spot.width() / 8), std::max(1, spot.height() / 8));
  }
  Plane cells;
  if (!fit(cells)) {
    return false;
  }
  // Between four cells. Each is the neighbour of several spots; two of its four are enough.
  m_samples.clear();
  for (const vpPatternSpot &spot : spots) {
    double row = 0., column = 0.;
    lattice.invert(spot.x, spot.y, row, column);
    row = std::round(row);
    column = std::round(column);
    for (const double half : {-0.5, 0.5}) {
      add(image, lattice.x(row + half, column + half), lattice.y(row + half, column + half), 1, 1);
    }
  }
  Plane gaps;
  const bool both = fit(gaps);
  const double value = cells.value + (both ? gaps.value : 0.);
  if (!(value > 1.)) {
    return false;
  }
  m_images = std::min(m_images + 1, 20);
  m_slopeX += ((cells.slopeX + (both ? gaps.slopeX : 0.)) / value - m_slopeX) / m_images;
  m_slopeY += ((cells.slopeY + (both ? gaps.slopeY : 0.)) / value - m_slopeY) / m_images;
  return true;
}

vpEdgeLevel vpLightSlope::level(double middle) const
{
  return {middle * (1. - m_slopeX * m_middleX - m_slopeY * m_middleY), middle * m_slopeX, middle * m_slopeY};
}

END_VISP_NAMESPACE
