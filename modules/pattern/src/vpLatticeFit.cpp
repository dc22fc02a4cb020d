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
constexpr std::size_t leastSpots = 4; // two by two
constexpr double offLattice = 0.25;   // pitch: maximum deviation of a cell, in a tilted view or of a flexible product
constexpr std::size_t maxSeeds = 16;  // that search their neighbours: enough for a vote, near enough to be even
} // namespace

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

vpLatticeFit::vpLatticeFit(std::size_t maxSpots)
{
  m_sorted.reserve(maxSpots);
  m_nodes.reserve(maxSpots);
  m_reached.reserve(maxSpots);
  m_seeds.reserve(maxSpots);
}

// Area with the most others within this factor, from sorted areas; 0 when too few are alike.
int vpLatticeFit::commonestArea(double tolerance) const
{
  std::size_t most = 0, low = 0, high = 0;
  int area = 0;
  for (const int candidate : m_sorted) {
    while (m_sorted[low] * tolerance < candidate) {
      ++low;
    }
    while (high < m_sorted.size() && m_sorted[high] <= candidate * tolerance) {
      ++high;
    }
    // For equal numbers, the larger spots: specks of noise are alike, too.
    if (high - low >= leastSpots && (high - low) * static_cast<std::size_t>(candidate) >= most) {
      most = (high - low) * static_cast<std::size_t>(candidate);
      area = candidate;
    }
  }
  return area;
}

bool vpLatticeFit::keepAlike(std::vector<vpPatternSpot> &spots)
{
  // The most common area: the one with the most others within a fifth; noise and dust are many but not alike. Then all
  // spots within the range that a tilted view causes.
  m_sorted.clear();
  for (const vpPatternSpot &spot : spots) {
    m_sorted.push_back(spot.area);
  }
  std::sort(m_sorted.begin(), m_sorted.end());
  // A tilted view of few cells does not have four of the same size.
  int area = 0;
  for (const double tolerance : {1.2, 1.7}) {
    area = area == 0 ? commonestArea(tolerance) : area;
  }
  spots.erase(std::remove_if(spots.begin(), spots.end(),
                             [&](const vpPatternSpot &s) { return 2 * s.area > 5 * area || 5 * s.area < 2 * area; }),
              spots.end());
  if (area == 0 || spots.size() < leastSpots) {
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
  return keepKnown(spots) && spots.size() >= leastSpots;
}

bool vpLatticeFit::isLikeMedian(const vpPatternSpot &spot) const
{
  return std::abs(spot.width() - m_width) <= 2 + 2 * m_width / 5 &&
         std::abs(spot.height() - m_height) <= 2 + 2 * m_height / 5;
}

bool vpLatticeFit::keepKnown(std::vector<vpPatternSpot> &spots) const
{
  spots.erase(std::remove_if(spots.begin(), spots.end(), [this](const vpPatternSpot &s) { return !isLikeMedian(s); }),
              spots.end());
  return !spots.empty();
}

bool vpLatticeFit::shift(const std::vector<vpPatternSpot> &spots, vpLattice &lattice) const
{
  // The first spot determines a lattice; the others must agree.
  double sx = 0., sy = 0.;
  for (const vpPatternSpot &spot : spots) {
    double dx = spot.x - spots[0].x, dy = spot.y - spots[0].y;
    lattice.reduce(dx, dy);
    if (std::abs(dx) > 0.1 * m_width + 1. || std::abs(dy) > 0.1 * m_height + 1.) {
      return false;
    }
    sx += dx / static_cast<double>(spots.size());
    sy += dy / static_cast<double>(spots.size());
  }
  lattice.ox = spots[0].x + sx;
  lattice.oy = spots[0].y + sy;
  return true;
}

void vpLatticeFit::removeDirty(std::vector<vpPatternSpot> &spots)
{
  // In a tilted view the logarithm of the area is linear over the image. Dirt changes it for some spots: fitted twice,
  // the second time without outliers.
  constexpr double tolerance[] = {0.25, 0.06};
  for (const double limit : tolerance) {
    Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const auto row = [](const vpPatternSpot &s) { return Eigen::Vector3d(1., 1e-3 * s.x, 1e-3 * s.y); };
    for (const vpPatternSpot &spot : spots) {
      normal += row(spot) * row(spot).transpose();
      right += row(spot) * std::log(spot.area);
    }
    const Eigen::Vector3d even = normal.ldlt().solve(right);
    const auto dirty = [&](const vpPatternSpot &s) {
      const double rounding = 2. * (s.width() + s.height()) / s.area; // one pixel more or less all around: not dirt
      return std::abs(std::log(s.area) - even.dot(row(s))) > limit + std::min(0.15, 0.1 * rounding);
    };
    if (2 * std::count_if(spots.begin(), spots.end(), dirty) > static_cast<std::ptrdiff_t>(spots.size())) {
      return; // not even linear: no conclusion possible
    }
    spots.erase(std::remove_if(spots.begin(), spots.end(), dirty), spots.end());
  }
}

// The spots nearest to the middle of all, nearest first.
void vpLatticeFit::findSeeds(const std::vector<vpPatternSpot> &spots)
{
  double sx = 0., sy = 0.;
  for (const vpPatternSpot &spot : spots) {
    sx += spot.x / static_cast<double>(spots.size());
    sy += spot.y / static_cast<double>(spots.size());
  }
  m_seeds.clear();
  for (std::size_t i = 0; i < spots.size(); ++i) {
    const double dx = spots[i].x - sx, dy = spots[i].y - sy;
    m_seeds.push_back({dx * dx + dy * dy, i});
  }
  const std::size_t count = std::min(maxSeeds, spots.size());
  std::partial_sort(m_seeds.begin(), m_seeds.begin() + static_cast<std::ptrdiff_t>(count), m_seeds.end());
  m_seeds.resize(count);
}

// The most common vector to the next spot on the right (or below): each seed proposes one, the one with most others
// wins.
bool vpLatticeFit::direction(const std::vector<vpPatternSpot> &spots, bool down, double minPitch, double &vx,
                             double &vy)
{
  std::array<double, maxSeeds> x{}, y{};
  std::size_t count = 0;
  for (const auto &candidate : m_seeds) {
    const vpPatternSpot &seed = spots[candidate.second];
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
    const double limit = 0.2 * std::sqrt(x[i] * x[i] + y[i] * y[i]) + 1.;
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

// Index of the spot nearest to a point, within reach; otherwise the number of spots. Spots are sorted by top.
std::size_t vpLatticeFit::nearest(const std::vector<vpPatternSpot> &spots, double x, double y, double reach) const
{
  const int high = 2 * m_height + 3; // no spot is higher
  const auto first = std::lower_bound(spots.begin(), spots.end(), static_cast<int>(y - reach) - high,
                                      [](const vpPatternSpot &spot, int top) { return spot.top < top; });
  std::size_t best = spots.size();
  double least = reach * reach;
  for (auto spot = first; spot != spots.end() && spot->top <= y + reach; ++spot) {
    const double dx = spot->x - x, dy = spot->y - y, d = dx * dx + dy * dy;
    if (d < least) {
      least = d;
      best = static_cast<std::size_t>(spot - spots.begin());
    }
  }
  return best;
}

// From neighbour to neighbour: steps may vary on the way, in a tilted view or on a flexible product.
void vpLatticeFit::walk(const std::vector<vpPatternSpot> &spots, std::size_t seed, const vpLattice &lattice)
{
  m_nodes.assign(spots.size(), Node());
  m_reached.clear();
  m_nodes[seed] = {true, 0, 0, lattice.ax, lattice.ay, lattice.bx, lattice.by};
  m_reached.push_back(seed);
  for (std::size_t k = 0; k < m_reached.size(); ++k) {
    const Node node = m_nodes[m_reached[k]];
    const vpPatternSpot &from = spots[m_reached[k]];
    const double reach =
        offLattice * std::sqrt(std::min(node.ax * node.ax + node.ay * node.ay, node.bx * node.bx + node.by * node.by));
    for (int step = 0; step < 4; ++step) {
      const bool along = step < 2;
      const int sign = step % 2 == 0 ? 1 : -1;
      const double vx = along ? node.ax : node.bx, vy = along ? node.ay : node.by;
      const std::size_t i = nearest(spots, from.x + sign * vx, from.y + sign * vy, reach);
      if (i == spots.size() || m_nodes[i].reached) {
        continue;
      }
      Node &to = m_nodes[i];
      to = node;
      (along ? to.column : to.row) += sign;
      // Half of the observed change: the cells vary, too.
      (along ? to.ax : to.bx) += 0.5 * (sign * (spots[i].x - from.x) - vx);
      (along ? to.ay : to.by) += 0.5 * (sign * (spots[i].y - from.y) - vy);
      m_reached.push_back(i);
    }
  }
}

// Least squares over the reached spots. False when they do not span two directions.
bool vpLatticeFit::solve(const std::vector<vpPatternSpot> &spots, vpLattice &lattice) const
{
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (const std::size_t i : m_reached) {
    const Eigen::Vector3d a(1., m_nodes[i].column, m_nodes[i].row);
    normal += a * a.transpose();
    right += a * Eigen::RowVector2d(spots[i].x, spots[i].y);
  }
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(normal);
  if (m_reached.size() < leastSpots || ldlt.vectorD().minCoeff() < 1e-6) {
    return false;
  }
  const Eigen::Matrix<double, 3, 2> s = ldlt.solve(right);
  lattice = {s(0, 0), s(0, 1), s(1, 0), s(1, 1), s(2, 0), s(2, 1)};
  return true;
}

vpPatternReason vpLatticeFit::trouble(const std::vector<vpPatternSpot> &spots) const
{
  constexpr double degree = 0.017453292519943295;
  constexpr double straight = 0.25;     // of the pitch
  constexpr double same = 10. * degree; // by chance 22 % of the directions lie within it
  constexpr double mostTurned = 30. * degree;
  const std::size_t n = m_seeds.size();
  if (n < leastSpots) {
    return vpPatternReason::NoLattice;
  }
  std::array<double, maxSeeds> turn{},
      pitch{}; // of the vector to the nearest spot; turned by whole right angles to within 45 deg
  for (std::size_t k = 0; k < n; ++k) {
    const vpPatternSpot &seed = spots[m_seeds[k].second];
    double least = std::numeric_limits<double>::infinity();
    for (const vpPatternSpot &other : spots) {
      const double dx = other.x - seed.x, dy = other.y - seed.y, d = dx * dx + dy * dy;
      if (d > 0. && d < least) {
        least = d;
        turn[k] = std::remainder(std::atan2(dy, dx), 90. * degree);
      }
    }
    pitch[k] = std::sqrt(least);
  }
  // The variance across the line that fits best: the smaller eigenvalue.
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const vpPatternSpot &spot : spots) {
    mean += Eigen::Vector2d(spot.x, spot.y) / static_cast<double>(spots.size());
  }
  for (const vpPatternSpot &spot : spots) {
    const Eigen::Vector2d d = Eigen::Vector2d(spot.x, spot.y) - mean;
    spread += d * d.transpose() / static_cast<double>(spots.size());
  }
  std::array<double, maxSeeds> sorted = pitch;
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(n));
  const double usual = sorted[n / 2];
  const double across = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>().computeDirect(spread).eigenvalues()(0);
  if (across < straight * straight * usual * usual) {
    return vpPatternReason::SingleRow;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto agree = std::count_if(turn.begin(), turn.begin() + static_cast<std::ptrdiff_t>(n), [&](double other) {
      return std::abs(std::remainder(other - turn[k], 90. * degree)) < same;
    });
    if (std::abs(turn[k]) > mostTurned && 3 * static_cast<std::size_t>(agree) >= 2 * n) {
      return vpPatternReason::TurnedTooFar;
    }
  }
  return vpPatternReason::NoLattice;
}

bool vpLatticeFit::fit(std::vector<vpPatternSpot> &spots, double minPitch, vpLattice &lattice)
{
  vpLattice l;
  findSeeds(spots);
  if (!direction(spots, false, minPitch, l.ax, l.ay) || !direction(spots, true, minPitch, l.bx, l.by)) {
    return false;
  }
  // Overlapping cells or parallel vectors are no lattice.
  if (l.ax * l.by - l.ay * l.bx < 0.5 * std::hypot(l.ax, l.ay) * std::hypot(l.bx, l.by)) {
    return false;
  }
  walk(spots, m_seeds[0].second, l);
  if (!solve(spots, l)) {
    return false;
  }
  // Spots that were reached, or lie behind a gap on the same lattice; the position must match the rounded indices.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    double row = 0., column = 0.;
    l.invert(spots[i].x, spots[i].y, row, column);
    const double r = std::round(row), c = std::round(column);
    m_nodes[i].reached = m_nodes[i].reached
                             ? m_nodes[i].row == static_cast<int>(r) && m_nodes[i].column == static_cast<int>(c)
                             : std::abs(row - r) < offLattice && std::abs(column - c) < offLattice;
    kept += m_nodes[i].reached ? 1 : 0;
  }
  if (kept < leastSpots || kept * 10 < spots.size() * 6) {
    return false;
  }
  kept = 0;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    if (m_nodes[i].reached) {
      spots[kept++] = spots[i];
    }
  }
  spots.resize(kept);
  lattice = l;
  return true;
}

END_VISP_NAMESPACE
