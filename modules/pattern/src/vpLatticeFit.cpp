/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLatticeFit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t maxSeeds = 24; // that look for their neighbours: enough for a vote, few enough for big images
}

void vpLattice::invert(double px, double py, double &row, double &column) const
{
  const double det = ax * by - ay * bx, dx = px - ox, dy = py - oy;
  column = (dx * by - dy * bx) / det;
  row = (dy * ax - dx * ay) / det;
}

void vpLattice::reduce(double &dx, double &dy) const
{
  const double det = ax * by - ay * bx;
  const double column = std::round((dx * by - dy * bx) / det), row = std::round((dy * ax - dx * ay) / det);
  dx -= column * ax + row * bx;
  dy -= column * ay + row * by;
}

vpLatticeFit::vpLatticeFit(std::size_t maxSpots) { m_sorted.reserve(maxSpots); }

bool vpLatticeFit::keepAlike(std::vector<vpPatternSpot> &spots)
{
  // The commonest area: the one with the most others within a fifth; noise and dust are many but not alike.
  m_sorted.clear();
  for (const vpPatternSpot &spot : spots) {
    m_sorted.push_back(spot.area);
  }
  std::sort(m_sorted.begin(), m_sorted.end());
  std::size_t most = 0, low = 0, high = 0;
  int area = 0;
  for (const int candidate : m_sorted) {
    while (m_sorted[low] * 6 < candidate * 5) {
      ++low;
    }
    while (high < m_sorted.size() && m_sorted[high] * 5 <= candidate * 6) {
      ++high;
    }
    // Of equal numbers the greater spots: specks of noise are alike, too.
    if ((high - low) * static_cast<std::size_t>(candidate) >= most) {
      most = (high - low) * static_cast<std::size_t>(candidate);
      area = candidate;
    }
  }
  spots.erase(std::remove_if(spots.begin(), spots.end(),
                             [&](const vpPatternSpot &s) { return s.area * 5 > area * 6 || s.area * 6 < area * 5; }),
              spots.end());
  if (spots.size() < 4) {
    return false;
  }
  const auto median = [&](bool wide) {
    m_sorted.clear();
    for (const vpPatternSpot &spot : spots) {
      m_sorted.push_back(wide ? spot.width() : spot.height());
    }
    const auto mid = m_sorted.begin() + static_cast<std::ptrdiff_t>(m_sorted.size() / 2);
    std::nth_element(m_sorted.begin(), mid, m_sorted.end());
    return *mid;
  };
  m_width = median(true);
  m_height = median(false);
  spots.erase(std::remove_if(spots.begin(), spots.end(),
                             [&](const vpPatternSpot &s) {
                               return std::abs(s.width() - m_width) > 2 + m_width / 10 ||
                                      std::abs(s.height() - m_height) > 2 + m_height / 10;
                             }),
              spots.end());
  return spots.size() >= 4;
}

// The commonest vector to the next spot on the right (or below): each seed names one, the one with most others wins.
bool vpLatticeFit::direction(const std::vector<vpPatternSpot> &spots, bool down, double minPitch, double &vx,
                             double &vy)
{
  std::array<double, maxSeeds> x{}, y{};
  std::size_t count = 0;
  const std::size_t seeds = std::min(maxSeeds, spots.size());
  for (std::size_t k = 0; k < seeds; ++k) {
    const vpPatternSpot &seed = spots[k * spots.size() / seeds];
    double nearest = std::numeric_limits<double>::infinity();
    for (const vpPatternSpot &other : spots) {
      const double dx = other.x - seed.x, dy = other.y - seed.y;
      const double along = down ? dy : dx, across = std::abs(down ? dx : dy);
      if (along >= 0.5 * minPitch && across < 0.7 * along && along * along + across * across < nearest) {
        nearest = along * along + across * across;
        x[count] = dx;
        y[count] = dy;
      }
    }
    count += std::isfinite(nearest) ? 1 : 0;
  }
  std::size_t most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    double sx = 0., sy = 0.;
    std::size_t votes = 0;
    const double limit = 0.08 * std::sqrt(x[i] * x[i] + y[i] * y[i]) + 1.;
    for (std::size_t k = 0; k < count; ++k) {
      const double dx = x[k] - x[i], dy = y[k] - y[i];
      if (dx * dx + dy * dy < limit * limit) {
        sx += x[k];
        sy += y[k];
        ++votes;
      }
    }
    if (votes > most) {
      most = votes;
      vx = sx / static_cast<double>(votes);
      vy = sy / static_cast<double>(votes);
    }
  }
  return most >= 2 && 2 * most >= count && std::hypot(vx, vy) >= minPitch;
}

// Least squares over the spots within \e reach pitches of the origin that are near their lattice point.
bool vpLatticeFit::solve(const std::vector<vpPatternSpot> &spots, double reach, vpLattice &lattice,
                         std::size_t &inliers)
{
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  inliers = 0;
  for (const vpPatternSpot &spot : spots) {
    double row = 0., column = 0.;
    lattice.invert(spot.x, spot.y, row, column);
    const double r = std::round(row), c = std::round(column);
    if (std::abs(r) > reach || std::abs(c) > reach || std::abs(row - r) > 0.2 || std::abs(column - c) > 0.2) {
      continue;
    }
    const Eigen::Vector3d a(1., c, r);
    normal += a * a.transpose();
    right += a * Eigen::RowVector2d(spot.x, spot.y);
    ++inliers;
  }
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(normal);
  if (inliers < 4 || ldlt.vectorD().minCoeff() < 1e-6) {
    return false;
  }
  const Eigen::Matrix<double, 3, 2> s = ldlt.solve(right);
  lattice = {s(0, 0), s(0, 1), s(1, 0), s(1, 1), s(2, 0), s(2, 1)};
  return true;
}

bool vpLatticeFit::fit(std::vector<vpPatternSpot> &spots, double minPitch, vpLattice &lattice)
{
  vpLattice l;
  if (!direction(spots, false, minPitch, l.ax, l.ay) || !direction(spots, true, minPitch, l.bx, l.by)) {
    return false;
  }
  // Overlapping cells or parallel vectors are no lattice.
  if (l.ax * l.by - l.ay * l.bx < 0.5 * std::hypot(l.ax, l.ay) * std::hypot(l.bx, l.by)) {
    return false;
  }
  // The spot nearest to the middle starts; the lattice grows from it, so that an error of the pitch cannot add up.
  double sx = 0., sy = 0.;
  for (const vpPatternSpot &spot : spots) {
    sx += spot.x / static_cast<double>(spots.size());
    sy += spot.y / static_cast<double>(spots.size());
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const vpPatternSpot &spot : spots) {
    const double dx = spot.x - sx, dy = spot.y - sy, d = dx * dx + dy * dy;
    if (d < nearest) {
      nearest = d;
      l.ox = spot.x;
      l.oy = spot.y;
    }
  }
  std::size_t inliers = 0, before = 0;
  for (double reach = 2.; reach < 20000.; reach *= 2.) {
    if (!solve(spots, reach, l, inliers)) {
      continue;
    }
    if (inliers == before) {
      break;
    }
    before = inliers;
  }
  if (inliers < 4 || inliers * 10 < spots.size() * 6) {
    return false;
  }
  lattice = l;
  spots.erase(std::remove_if(spots.begin(), spots.end(),
                             [&](const vpPatternSpot &s) {
                               double row = 0., column = 0.;
                               l.invert(s.x, s.y, row, column);
                               return std::abs(row - std::round(row)) > 0.2 ||
                                      std::abs(column - std::round(column)) > 0.2;
                             }),
              spots.end());
  return true;
}

END_VISP_NAMESPACE
