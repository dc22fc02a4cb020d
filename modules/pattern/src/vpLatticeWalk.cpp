/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLatticeWalk.h"

#include <visp3/direct_core/vpQuantile.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double margin = 2.;      // px around the box of the spots
constexpr double walkReach = 0.3;  // of the shorter step
constexpr double nextReach = 0.2;  // of the step, for the occupancy
constexpr double gain = 0.4;       // share of the observed step error that is corrected
constexpr double strayShare = 0.1; // of the pitch: perspective of third order is no outlier

using Terms = Eigen::Matrix<double, 6, 1>;

Terms termsOf(double row, double column)
{
  Terms terms;
  terms << 1., column, row, column * column, column * row, row * row;
  return terms;
}
} // namespace

vpSpotIndex::vpSpotIndex(const std::vector<vpLatticeSpot> &spots) : m_spots(spots)
{
  m_low.setConstant(1e9);
  m_high.setConstant(-1e9);
  for (const vpLatticeSpot &spot : spots) {
    m_low = m_low.cwiseMin(Eigen::Vector2d(spot.x, spot.y));
    m_high = m_high.cwiseMax(Eigen::Vector2d(spot.x, spot.y));
  }
  m_low.array() -= margin;
  m_high.array() += margin;
  m_cell = std::max(4., std::sqrt(size().prod() / static_cast<double>(std::max<std::size_t>(1, spots.size()))));
  for (const int axis : {0, 1}) {
    m_cells[axis] = static_cast<int>(size()[axis] / m_cell) + 1;
  }
  m_lists.resize(static_cast<std::size_t>(m_cells[0]) * static_cast<std::size_t>(m_cells[1]));
  for (std::size_t i = 0; i < spots.size(); ++i) {
    m_lists[static_cast<std::size_t>(cell(spots[i].y, 1) * m_cells[0] + cell(spots[i].x, 0))].push_back(
        static_cast<int>(i));
  }
}

int vpSpotIndex::cell(double x, int axis) const
{
  return static_cast<int>(std::clamp((x - m_low[axis]) / m_cell, 0., m_cells[axis] - 1.));
}

int vpSpotIndex::nearest(const Eigen::Vector2d &place, double reach) const
{
  int best = -1;
  double least = reach * reach;
  for (int v = cell(place.y() - reach, 1); v <= cell(place.y() + reach, 1); ++v) {
    for (int u = cell(place.x() - reach, 0); u <= cell(place.x() + reach, 0); ++u) {
      for (const int i : m_lists[static_cast<std::size_t>(v * m_cells[0] + u)]) {
        const double d = (this->place(static_cast<std::size_t>(i)) - place).squaredNorm();
        if (d < least) {
          least = d;
          best = i;
        }
      }
    }
  }
  return best;
}

bool vpSpotIndex::inView(const Eigen::Vector2d &place) const
{
  return (place.array() >= m_low.array()).all() && (place.array() <= m_high.array()).all();
}

vpLatticeWalk::vpLatticeWalk(const vpSpotIndex &index, std::size_t seed, const Eigen::Vector2d &a,
                             const Eigen::Vector2d &b)
  : m_index(index), m_nodes(index.count())
{
  m_nodes[seed] = {true, 0, 0, a, b};
  std::vector<std::size_t> reached = {seed};
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Node from = m_nodes[reached[k]];
    const double reach = walkReach * std::sqrt(std::min(from.a.squaredNorm(), from.b.squaredNorm()));
    for (int step = 0; step < 8; ++step) {
      const bool along = step < 4;
      const int sign = step % 2 == 0 ? 1 : -1, length = step % 4 < 2 ? 1 : 2;
      const Eigen::Vector2d vector = sign * length * (along ? from.a : from.b);
      const int found = m_index.nearest(m_index.place(reached[k]) + vector, reach);
      if (found < 0 || m_nodes[static_cast<std::size_t>(found)].on) {
        continue;
      }
      const auto i = static_cast<std::size_t>(found);
      Node &to = m_nodes[i];
      to = from;
      (along ? to.column : to.row) += sign * length;
      (along ? to.a : to.b) += gain * sign / length * (m_index.place(i) - m_index.place(reached[k]) - vector);
      reached.push_back(i);
    }
  }
}

double vpLatticeWalk::occupancy() const
{
  int inView = 0, met = 0;
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    for (const Eigen::Vector2d &step : {m_nodes[i].a, m_nodes[i].b}) {
      for (const double sign : {1., -1.}) {
        const Eigen::Vector2d place = m_index.place(i) + sign * step;
        if (m_nodes[i].on && m_index.inView(place)) {
          ++inView;
          met += m_index.nearest(place, nextReach * step.norm()) >= 0 ? 1 : 0;
        }
      }
    }
  }
  return inView > 0 ? static_cast<double>(met) / inView : 0.;
}

bool vpLatticeWalk::fit(const Eigen::Vector2d &middle, Eigen::Vector2d &a, Eigen::Vector2d &b, double &rms)
{
  const double pitch = std::min(a.norm(), b.norm());
  Eigen::Matrix<double, 6, 2> bent;
  std::vector<char> good(m_nodes.size());
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    good[i] = m_nodes[i].on ? 1 : 0;
  }
  for (int round = 0; round < 3; ++round) { // without the outliers of the previous round
    Eigen::Matrix<double, 6, 6> normal = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 2> right = Eigen::Matrix<double, 6, 2>::Zero();
    for (std::size_t i = 0; i < m_nodes.size(); ++i) {
      if (good[i] != 0) {
        const Terms terms = termsOf(m_nodes[i].row, m_nodes[i].column);
        normal += terms * terms.transpose();
        right += terms * m_index.place(i).transpose();
      }
    }
    if (std::count(good.begin(), good.end(), 1) < 6) {
      return false;
    }
    bent = normal.ldlt().solve(right);
    std::vector<double> misses(m_nodes.size(), -1.), some;
    for (std::size_t i = 0; i < m_nodes.size(); ++i) {
      if (m_nodes[i].on) {
        const Eigen::RowVector2d expected = termsOf(m_nodes[i].row, m_nodes[i].column).transpose() * bent;
        misses[i] = (expected.transpose() - m_index.place(i)).norm();
        some.push_back(misses[i]);
      }
    }
    const double limit = std::max({0.5, 4. * vpMedian(some), strayShare * pitch});
    double squares = 0.;
    for (std::size_t i = 0; i < m_nodes.size(); ++i) {
      good[i] = misses[i] >= 0. && misses[i] < limit ? 1 : 0;
      squares += good[i] != 0 ? misses[i] * misses[i] : 0.;
    }
    rms = std::sqrt(squares / std::max<double>(1., static_cast<double>(std::count(good.begin(), good.end(), 1))));
  }
  double least = 1e18;
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    m_nodes[i].on = good[i] != 0;
    const double distance = (m_index.place(i) - middle).squaredNorm();
    if (m_nodes[i].on && distance < least) {
      least = distance;
      const double row = m_nodes[i].row, column = m_nodes[i].column;
      a = (bent.row(1) + 2. * bent.row(3) * column + bent.row(4) * row).transpose();
      b = (bent.row(2) + bent.row(4) * column + 2. * bent.row(5) * row).transpose();
    }
  }
  return true;
}

bool vpLatticeWalk::isRow() const
{
  std::map<int, int> rows, columns;
  int most = 0;
  for (const Node &node : m_nodes) {
    if (node.on) {
      most = std::max({most, ++rows[node.row], ++columns[node.column]});
    }
  }
  return most > 0.7 * count();
}

int vpLatticeWalk::count() const
{
  return static_cast<int>(std::count_if(m_nodes.begin(), m_nodes.end(), [](const Node &node) { return node.on; }));
}

END_VISP_NAMESPACE
