/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCoverFit.h"
#include "vpCoverMeasure.h"

#include <Eigen/Eigenvalues>

#include <set>

BEGIN_VISP_NAMESPACE

namespace vpCover
{
namespace
{
constexpr int roundsOfAssignment = 6, startsByMeans = 8, cutsOfSplit = 5;
constexpr int stepsOfFirst = 400, stepsOfSplit = 40, stepsOfStart = 60, stepsOfAssignment = 150;

Eigen::Vector3d meanOf(const Points &points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d &p : points) {
    sum += p;
  }
  return sum / static_cast<double>(points.size());
}

std::vector<vpArmCapsule> capsulesOf(const std::vector<Cluster> &clusters)
{
  std::vector<vpArmCapsule> capsules;
  for (const Cluster &c : clusters) {
    capsules.push_back(c.capsule);
  }
  return capsules;
}

// Principal axes of points.
std::vector<Eigen::Vector3d> principalAxes(const Points &points)
{
  const Eigen::Vector3d mean = meanOf(points);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d &p : points) {
    scatter += (p - mean) * (p - mean).transpose();
  }
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors();
  return {axes.col(0), axes.col(1), axes.col(2)};
}

// Nearly the smallest circle about points in the plane (Badoiu and Clarkson, 2003); its radius holds them exactly.
double smallestCircle(const std::vector<Eigen::Vector2d> &points, Eigen::Vector2d &centre)
{
  const auto farthestFrom = [&points](const Eigen::Vector2d &c) {
    return *std::max_element(points.begin(), points.end(), [&c](const Eigen::Vector2d &a, const Eigen::Vector2d &b) {
      return (a - c).squaredNorm() < (b - c).squaredNorm();
    });
  };
  centre = points[0];
  for (int k = 1; k <= 60; ++k) {
    centre += (farthestFrom(centre) - centre) / (k + 1.);
  }
  return (farthestFrom(centre) - centre).norm();
}
} // namespace

Fit::Fit(const vpTriangleMesh &mesh, const Cells &cells, unsigned int seed)
  : m_mesh(mesh), m_cells(cells), m_field(mesh), m_random(seed), m_directions(directions(120))
{
  for (const Eigen::Vector3d &d : directions(24)) {
    if (d.z() >= 0.) {
      m_axes.push_back(d);
    }
  }
}

double Fit::uniform() { return 0x1p-53 * static_cast<double>(m_random() >> 11U); }

// The points that matter for most capsules; what the others need is added to the radius at the end.
Points Fit::extremes(const Points &points) const
{
  if (points.size() < 80) {
    return points;
  }
  std::set<std::size_t> chosen;
  for (const Eigen::Vector3d &d : m_directions) {
    std::size_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = d.dot(points[i]);
      if (x > most) {
        most = x;
        best = i;
      }
    }
    chosen.insert(best);
  }
  Points result;
  for (const std::size_t i : chosen) {
    result.push_back(points[i]);
  }
  return result;
}

Points Fit::pointsOf(const std::vector<int> &cells) const
{
  std::vector<bool> seen(m_cells.points.size(), false);
  Points result;
  for (const int c : cells) {
    const Cell &cell = m_cells.cells[at(c)];
    for (std::size_t k = 0; k < cell.size; ++k) {
      const std::size_t i = at(cell.corners[k]);
      if (!seen[i]) {
        seen[i] = true;
        result.push_back(m_cells.points[i]);
      }
    }
  }
  return result;
}

Points Fit::centresOf(const std::vector<int> &cells) const
{
  Points result;
  for (const int c : cells) {
    result.push_back(m_cells.cells[at(c)].centre);
  }
  return result;
}

// The capsule about an axis: smallest circle across, wider by excess, with ends where the caps just hold the points.
vpArmCapsule Fit::along(const Points &points, const Eigen::Vector3d &axis, double excess) const
{
  const Eigen::Vector3d x = axis.unitOrthogonal(), y = axis.cross(x);
  std::vector<Eigen::Vector2d> across;
  for (const Eigen::Vector3d &p : points) {
    across.emplace_back(x.dot(p), y.dot(p));
  }
  Eigen::Vector2d centre;
  const double r = (1. + excess) * smallestCircle(across, centre);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double cap = std::sqrt(std::max(0., r * r - (across[i] - centre).squaredNorm()));
    const double t = axis.dot(points[i]);
    high = std::max(high, t - cap);
    low = std::min(low, t + cap);
  }
  if (low > high) {
    low = high = 0.5 * (low + high);
  }
  const Eigen::Vector3d origin = centre.x() * x + centre.y() * y;
  vpArmCapsule c;
  c.from = origin + low * axis;
  c.to = origin + high * axis;
  c.radius = farthest(points, c.from, c.to);
  return c;
}

// Random search on both ends; the step grows with each success.
void Fit::improve(const Points &extreme, int steps, vpArmCapsule &best, double least)
{
  double step = 0.1 * best.radius;
  for (int k = 0; k < steps && step > 1e-5; ++k) {
    vpArmCapsule c = best;
    for (int i = 0; i < 3; ++i) {
      c.from(i) += step * (uniform() + uniform() + uniform() + uniform() - 2.) * std::sqrt(3.); // variance 1
      c.to(i) += step * (uniform() + uniform() + uniform() + uniform() - 2.) * std::sqrt(3.);
    }
    c.radius = farthest(extreme, c.from, c.to);
    const double cost = m_field.cost(c);
    step *= cost < least ? 1.6 : 0.93;
    if (cost < least) {
      best = c;
      least = cost;
    }
  }
}

// The capsule about points that costs least in the field.
vpArmCapsule Fit::capsuleOf(const Points &all, int steps, const vpArmCapsule *start)
{
  const Points extreme = extremes(all);
  vpArmCapsule best;
  double least = std::numeric_limits<double>::infinity();
  const auto tryOut = [&](const vpArmCapsule &c) {
    const double cost = m_field.cost(c);
    if (cost < least) {
      best = c;
      least = cost;
    }
  };
  if (start != nullptr) {
    vpArmCapsule c = *start;
    c.radius = farthest(extreme, c.from, c.to);
    tryOut(c);
  }
  std::vector<Eigen::Vector3d> axes = principalAxes(extreme);
  if (steps >= stepsOfFirst) {
    axes.insert(axes.end(), m_axes.begin(), m_axes.end());
  }
  for (const Eigen::Vector3d &axis : axes) {
    for (const double excess : {0., 0.08, 0.25}) {
      tryOut(along(extreme, axis, excess));
    }
  }
  improve(extreme, steps, best, least);
  best.radius = farthest(all, best.from, best.to) + rounding;
  return best;
}

void Fit::takeAllBut(const Clusters &clusters, std::size_t j)
{
  m_field.reset();
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (i != j) {
      m_field.take(clusters[i].capsule);
    }
  }
}

// Of the union: each point counts once.
double Fit::costOf(const Clusters &clusters)
{
  m_field.reset();
  double sum = 0.;
  for (const Cluster &c : clusters) {
    sum += m_field.cost(c.capsule);
    m_field.take(c.capsule);
  }
  return sum;
}

// The best way to cut cluster j in two by a plane; returns what it gains, 0 if nothing.
double Fit::split(const Clusters &clusters, std::size_t j, Cluster &first, Cluster &second)
{
  const Cluster &whole = clusters[j];
  takeAllBut(clusters, j);
  const Field others = m_field;
  const double before = m_field.cost(whole.capsule);
  const Points centres = centresOf(whole.cells);
  std::vector<Eigen::Vector3d> axes = principalAxes(centres);
  const Eigen::Vector3d length = whole.capsule.to - whole.capsule.from;
  if (length.norm() > 1e-6) {
    axes.push_back(length.normalized());
  }
  double gain = 0.;
  for (const Eigen::Vector3d &axis : axes) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Eigen::Vector3d &c : centres) {
      low = std::min(low, axis.dot(c));
      high = std::max(high, axis.dot(c));
    }
    for (int s = 1; s <= cutsOfSplit; ++s) {
      const double cut = low + (high - low) * s / (cutsOfSplit + 1.);
      Cluster a, b;
      for (std::size_t i = 0; i < centres.size(); ++i) {
        (axis.dot(centres[i]) < cut ? a : b).cells.push_back(whole.cells[i]);
      }
      if (a.cells.empty() || b.cells.empty()) {
        continue;
      }
      m_field = others;
      a.capsule = capsuleOf(pointsOf(a.cells), stepsOfSplit);
      double cost = m_field.cost(a.capsule);
      m_field.take(a.capsule);
      b.capsule = capsuleOf(pointsOf(b.cells), stepsOfSplit);
      cost += m_field.cost(b.capsule);
      if (before - cost > gain) {
        gain = before - cost;
        first = a;
        second = b;
      }
    }
  }
  return gain;
}

// Gives each cell to the capsule that has to grow least; without the clusters that get none.
Fit::Clusters Fit::assigned(const Clusters &clusters) const
{
  Clusters result = clusters;
  for (Cluster &c : result) {
    c.cells.clear();
  }
  for (std::size_t i = 0; i < m_cells.cells.size(); ++i) {
    const Cell &cell = m_cells.cells[i];
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < clusters.size(); ++j) {
      const vpArmCapsule &c = clusters[j].capsule;
      const Eigen::Vector3d along = c.to - c.from;
      const double squaredLength = along.squaredNorm();
      double most = 0.;
      for (std::size_t k = 0; k < cell.size; ++k) {
        most = std::max(most, squaredDistance(m_cells.points[at(cell.corners[k])], c.from, along, squaredLength));
      }
      const double growth = std::sqrt(most) - c.radius;
      if (growth < least) {
        least = growth;
        best = j;
      }
    }
    result[best].cells.push_back(static_cast<int>(i));
  }
  result.erase(std::remove_if(result.begin(), result.end(), [](const Cluster &c) { return c.cells.empty(); }),
               result.end());
  return result;
}

// Assignment and fits in turn, while the cost of the union falls.
void Fit::alternate(Clusters &clusters)
{
  double before = costOf(clusters);
  for (int round = 0; round < roundsOfAssignment; ++round) {
    Clusters now = assigned(clusters);
    for (std::size_t j = 0; j < now.size(); ++j) {
      takeAllBut(now, j);
      const vpArmCapsule start = now[j].capsule;
      now[j].capsule = capsuleOf(pointsOf(now[j].cells), stepsOfAssignment, &start);
    }
    const double after = costOf(now);
    if (after < before) {
      clusters = now;
    }
    if (after > before * (1. - 1e-3)) {
      return;
    }
    before = after;
  }
}

// k-means of the cells' centres from starts that lie apart (k-means++: Arthur and Vassilvitskii, 2007).
Fit::Clusters Fit::byMeans(std::size_t count)
{
  const std::vector<Cell> &cells = m_cells.cells;
  Points means{cells[m_random() % cells.size()].centre};
  const auto nearestMean = [&means](const Eigen::Vector3d &p) {
    return std::min_element(means.begin(), means.end(), [&p](const Eigen::Vector3d &a, const Eigen::Vector3d &b) {
      return (a - p).squaredNorm() < (b - p).squaredNorm();
    });
  };
  while (means.size() < count) {
    std::vector<double> sums;
    for (const Cell &c : cells) {
      sums.push_back((sums.empty() ? 0. : sums.back()) + (*nearestMean(c.centre) - c.centre).squaredNorm());
    }
    const auto chosen = std::upper_bound(sums.begin(), sums.end() - 1, uniform() * sums.back());
    means.push_back(cells[static_cast<std::size_t>(chosen - sums.begin())].centre);
  }
  Clusters clusters;
  for (int round = 0; round < 8; ++round) {
    clusters.assign(count, {});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto mean = static_cast<std::size_t>(nearestMean(cells[i].centre) - means.begin());
      clusters[mean].cells.push_back(static_cast<int>(i));
    }
    for (std::size_t j = 0; j < count; ++j) {
      means[j] = clusters[j].cells.empty() ? means[j] : meanOf(centresOf(clusters[j].cells));
    }
  }
  clusters.erase(std::remove_if(clusters.begin(), clusters.end(), [](const Cluster &c) { return c.cells.empty(); }),
                 clusters.end());
  m_field.reset();
  for (Cluster &c : clusters) {
    c.capsule = capsuleOf(pointsOf(c.cells), stepsOfStart);
    m_field.take(c.capsule);
  }
  return clusters;
}

// One number for the two figures of a cover. The volume counts more, since overhangs are more alike.
double Fit::slackOf(const std::vector<vpArmCapsule> &capsules) const
{
  const double volume = unionVolume(capsules);
  return overhangOf(m_mesh, capsules) * volume * volume;
}

// Improves a proposal and keeps it if it is the best.
void Fit::keep(Clusters &&clusters)
{
  alternate(clusters);
  const double slack = slackOf(capsulesOf(clusters));
  if (slack < m_slack) {
    m_slack = slack;
    m_best = std::move(clusters);
  }
}

std::vector<vpArmCapsule> Fit::next()
{
  ++m_count;
  if (m_count == 1) {
    Cluster all;
    for (std::size_t i = 0; i < m_cells.cells.size(); ++i) {
      all.cells.push_back(static_cast<int>(i));
    }
    m_field.reset();
    all.capsule = capsuleOf(pointsOf(all.cells), stepsOfFirst);
    m_best = {all};
    m_slack = slackOf(capsulesOf(m_best));
  }
  else if (m_count <= m_cells.cells.size()) {
    Clusters divided;
    double gain = 0.;
    for (std::size_t j = 0; j < m_best.size(); ++j) {
      Cluster first, second;
      const double now = split(m_best, j, first, second);
      if (now > gain) {
        gain = now;
        divided = m_best;
        divided[j] = first;
        divided.push_back(second);
      }
    }
    if (gain > 0.) {
      keep(std::move(divided));
    }
    for (int start = 0; start < startsByMeans; ++start) {
      keep(byMeans(m_count));
    }
  }
  return capsulesOf(m_best);
}
} // namespace vpCover

END_VISP_NAMESPACE
