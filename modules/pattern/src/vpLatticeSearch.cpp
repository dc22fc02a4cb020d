/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLatticeSearch.h"

#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpTailProbability.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double tolerance = 0.16;   // of a vector's length: perspective and jitter
constexpr double leastHit = 0.35;    // rate beyond chance of a lattice vector
constexpr double shareOfBest = 0.72; // of the best rate
constexpr int neighbours = 14;       // of a spot, whose differences are used
constexpr int seeds = 40;
constexpr std::size_t mostVectors = 7;
constexpr double leastPrecision = 0.05; // of the pitch: no dot counts as more precise
constexpr double mostChance = 1e-6;     // that random spots lie so; some 1000 lattices are tried per image
constexpr double walkReach = 0.3;       // of the shorter step
constexpr double nextReach = 0.2;       // of the step, for the occupancy
constexpr double gain = 0.4;            // share of the observed step error that is corrected
constexpr double strayShare = 0.1;      // of the pitch: perspective of third order is no outlier

using Vectors = std::vector<Eigen::Vector2d>;

// The one of +-v on the side of another vector.
Eigen::Vector2d folded(const Eigen::Vector2d &v, const Eigen::Vector2d &like) { return v.dot(like) < 0. ? -v : v; }

double cross(const Eigen::Vector2d &a, const Eigen::Vector2d &b) { return a.x() * b.y() - a.y() * b.x(); }

using Terms = Eigen::Matrix<double, 6, 1>;

Terms termsOf(double row, double column)
{
  Terms terms;
  terms << 1., column, row, column * column, column * row, row * row;
  return terms;
}

// From spot to spot by the steps of a lattice, and the resulting measures of the lattice.
class Walk
{
public:
  struct Node {
    bool on = false;
    int row = 0, column = 0;
    Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero(); // steps to the neighbours here
  };

  // From a seed, with local steps, also over one missing spot.
  Walk(const vpSpotIndex &index, std::size_t seed, const Eigen::Vector2d &a, const Eigen::Vector2d &b);
  // Share of the single steps to positions in view that end at a spot.
  [[nodiscard]] double occupancy() const;
  // Fits a lattice bent to second order and removes outliers. False when it is not determined. Steps at a position: a,
  // b.
  bool fit(const Eigen::Vector2d &middle, Eigen::Vector2d &a, Eigen::Vector2d &b, double &rms);
  // Whether most nodes lie in one row or column: a row among outliers.
  [[nodiscard]] bool isRow() const;
  [[nodiscard]] int count() const;
  [[nodiscard]] const std::vector<Node> &nodes() const { return m_nodes; }

private:
  const vpSpotIndex &m_index; // owned by the caller
  std::vector<Node> m_nodes;  // one for each spot
};

Walk::Walk(const vpSpotIndex &index, std::size_t seed, const Eigen::Vector2d &a, const Eigen::Vector2d &b)
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

double Walk::occupancy() const
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

bool Walk::fit(const Eigen::Vector2d &middle, Eigen::Vector2d &a, Eigen::Vector2d &b, double &rms)
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

bool Walk::isRow() const
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

int Walk::count() const
{
  return static_cast<int>(std::count_if(m_nodes.begin(), m_nodes.end(), [](const Node &node) { return node.on; }));
}

class Search
{
public:
  Search(const std::vector<vpLatticeSpot> &spots, const Eigen::Vector2d &middle)
    : m_index(spots), m_middle(middle), m_least(vpLeastStep(spots))
  {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < spots.size(); ++i) {
      mean += m_index.place(i) / static_cast<double>(spots.size());
    }
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < spots.size(); ++i) {
      order.emplace_back((m_index.place(i) - mean).squaredNorm(), i);
    }
    std::sort(order.begin(), order.end());
    order.resize(std::min(spots.size(), std::max<std::size_t>(24, spots.size() / 2)));
    for (const auto &[distance, i] : order) {
      m_core.push_back(i);
    }
  }

  vpLatticeFound run() const
  {
    vpLatticeFound best;
    const Vectors vectors = latticeVectors();
    if (vectors.empty()) {
      best.why = "no step from spot to spot is common to them";
      return best;
    }
    best.why = "most spots are on no common lattice";
    Vectors tried; // candidates for a and b
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      for (std::size_t j = i + 1; j < vectors.size(); ++j) {
        Eigen::Vector2d a = vectors[i], b = vectors[j];
        if (!reduce(a, b) || isAmong(tried, a, b)) {
          continue;
        }
        tried.push_back(a);
        tried.push_back(b);
        for (const std::size_t seed : {m_core[0], m_core[std::min<std::size_t>(4, m_core.size() - 1)]}) {
          judge(seed, a, b, best);
        }
      }
    }
    return best;
  }

private:
  // Differences of the spots in the middle to their neighbours, by mean shift.
  [[nodiscard]] Vectors differences() const
  {
    Vectors all;
    const std::size_t count = std::min<std::size_t>(m_core.size(), seeds);
    for (std::size_t k = 0; k < count; ++k) {
      const Eigen::Vector2d from = m_index.place(m_core[k * m_core.size() / count]);
      std::vector<std::pair<double, std::size_t>> near;
      for (std::size_t j = 0; j < m_index.count(); ++j) {
        const double distance = (m_index.place(j) - from).norm();
        if (distance > m_least) {
          near.emplace_back(distance, j);
        }
      }
      const auto some = static_cast<std::ptrdiff_t>(std::min<std::size_t>(neighbours, near.size()));
      std::partial_sort(near.begin(), near.begin() + some, near.end());
      for (std::ptrdiff_t l = 0; l < some; ++l) {
        all.push_back(m_index.place(near[static_cast<std::size_t>(l)].second) - from);
      }
    }
    return all;
  }

  [[nodiscard]] Vectors clusters() const
  {
    const Vectors all = differences();
    const auto enough = std::max<std::size_t>(2, std::min<std::size_t>(m_core.size(), seeds) / 8);
    std::vector<char> used(all.size(), 0);
    Vectors means;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (used[i] != 0) {
        continue;
      }
      Eigen::Vector2d mean = all[i];
      std::size_t votes = 0;
      for (int round = 0; round < 3; ++round) {
        const Eigen::Vector2d centre = mean;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        votes = 0;
        for (const Eigen::Vector2d &v : all) {
          const Eigen::Vector2d q = folded(v, centre);
          if ((q - centre).norm() < tolerance * centre.norm()) {
            sum += q;
            ++votes;
          }
        }
        mean = votes > 0 ? Eigen::Vector2d(sum / static_cast<double>(votes)) : centre;
      }
      for (std::size_t j = i; j < all.size(); ++j) {
        if ((folded(all[j], mean) - mean).norm() < 0.7 * tolerance * mean.norm()) {
          used[j] = 1;
        }
      }
      used[i] = 1;
      const bool known = std::any_of(means.begin(), means.end(), [&](const Eigen::Vector2d &m) {
        return (folded(m, mean) - mean).norm() < 0.6 * tolerance * mean.norm();
      });
      if (votes >= enough && !known) {
        means.push_back(mean);
      }
    }
    return means;
  }

  // Share of the spots whose partner would be in view that have one, beyond chance.
  [[nodiscard]] double hitRate(const Eigen::Vector2d &v) const
  {
    const double reach = std::max(1.2, tolerance * v.norm());
    const Eigen::Vector2d size = m_index.size();
    const bool narrow = size.minCoeff() < 3. * reach; // one row, horizontal or vertical
    const double chance =
        narrow ? 0. : std::min(0.8, static_cast<double>(m_index.count()) * M_PI * reach * reach / (size.prod() + 1.));
    int inView = 0, met = 0;
    for (const std::size_t i : m_core) {
      for (const double sign : {1., -1.}) {
        const Eigen::Vector2d place = m_index.place(i) + sign * v;
        if (m_index.inView(place)) {
          ++inView;
          met += m_index.nearest(place, reach) >= 0 ? 1 : 0;
        }
      }
    }
    return inView >= 4 ? (static_cast<double>(met) / inView - chance) / (1. - chance) : 0.;
  }

  // The shortest of the shared vectors.
  [[nodiscard]] Vectors latticeVectors() const
  {
    const Vectors all = clusters();
    std::vector<double> rates;
    for (const Eigen::Vector2d &v : all) {
      rates.push_back(hitRate(v));
    }
    const double best = rates.empty() ? 0. : *std::max_element(rates.begin(), rates.end());
    Vectors good;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (rates[i] >= leastHit && rates[i] >= shareOfBest * best) {
        good.push_back(all[i]);
      }
    }
    std::sort(good.begin(), good.end(),
              [](const Eigen::Vector2d &a, const Eigen::Vector2d &b) { return a.norm() < b.norm(); });
    good.resize(std::min(good.size(), mostVectors));
    return good;
  }

  // Lagrange-Gauss reduction: the shortest basis of the same lattice. False when the two are nearly parallel.
  [[nodiscard]] bool reduce(Eigen::Vector2d &a, Eigen::Vector2d &b) const
  {
    if (std::abs(cross(a, b)) < 0.3 * a.norm() * b.norm()) {
      return false;
    }
    for (int round = 0; round < 20; ++round) {
      if (a.norm() > b.norm()) {
        std::swap(a, b);
      }
      const double k = std::round(a.dot(b) / a.squaredNorm());
      if (k == 0.) {
        break;
      }
      b -= k * a;
    }
    return a.norm() >= m_least;
  }

  static bool isAmong(const Vectors &tried, const Eigen::Vector2d &a, const Eigen::Vector2d &b)
  {
    for (std::size_t i = 0; i < tried.size(); i += 2) {
      if ((folded(tried[i], a) - a).norm() < 0.1 * a.norm() && (folded(tried[i + 1], b) - b).norm() < 0.1 * b.norm()) {
        return true;
      }
    }
    return false;
  }

  // Whether random spots would meet this many positions of a candidate lattice: the binomial tail. Six dots are
  // subtracted for the twelve parameters of the bent lattice.
  [[nodiscard]] bool mayBeChance(int count, double occupancy, double rms, double pitch) const
  {
    constexpr int spent = 6;
    if (count <= spent) {
      return true;
    }
    const double reach =
        std::clamp(3. * rms * std::sqrt(count / (count - 1. * spent)), leastPrecision * pitch, 0.3 * pitch);
    const double density = static_cast<double>(m_index.count()) / m_index.size().prod();
    const double met = std::min(0.9, density * M_PI * reach * reach);
    const double places = std::max<double>(count, std::round(count / occupancy)), above = count - spent;
    const double ratio = above * (1. - met) / ((places - count + 1.) * met);
    return vpFisherTail(ratio, 2. * (places - count + 1.), 2. * above) > mostChance;
  }

  void judge(std::size_t seed, Eigen::Vector2d a, Eigen::Vector2d b, vpLatticeFound &best) const
  {
    const double pitch = std::min(a.norm(), b.norm());
    Walk walk(m_index, seed, a, b);
    vpLatticeFound found;
    found.kind = vpDotLatticeKind::Plane;
    found.occupancy = walk.occupancy();
    const auto spots = static_cast<double>(m_index.count());
    if (!walk.fit(m_middle, a, b, found.rms) || walk.count() < 0.3 * spots || found.occupancy < 0.4 ||
        found.rms > 0.1 * pitch || walk.isRow() || mayBeChance(walk.count(), found.occupancy, found.rms, pitch)) {
      return;
    }
    double amplitude = 0.;
    for (std::size_t i = 0; i < m_index.count(); ++i) {
      if (walk.nodes()[i].on) {
        amplitude += m_index.spots()[i].amplitude / walk.count();
        found.spots.push_back(i);
        found.rows.push_back(walk.nodes()[i].row);
        found.columns.push_back(walk.nodes()[i].column);
      }
    }
    const double misses = found.rms / (0.04 * pitch);
    found.score = walk.count() * found.occupancy * amplitude / (1. + misses * misses);
    found.a = a;
    found.b = b;
    if (found.score > best.score) {
      best = found;
    }
  }

  vpSpotIndex m_index;
  Eigen::Vector2d m_middle;
  double m_least;
  std::vector<std::size_t> m_core; // the middle half, nearest first
};
} // namespace

double vpLeastStep(const std::vector<vpLatticeSpot> &spots)
{
  std::vector<double> areas;
  for (const vpLatticeSpot &spot : spots) {
    areas.push_back(spot.box.area);
  }
  return 1.1 * std::sqrt(4. / M_PI * vpMedian(areas));
}

vpLatticeFound vpSearchLattice(const std::vector<vpLatticeSpot> &spots, const Eigen::Vector2d &middle)
{
  return spots.size() < 4 ? vpLatticeFound() : Search(spots, middle).run();
}

END_VISP_NAMESPACE
