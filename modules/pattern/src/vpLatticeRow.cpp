/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLatticeSearch.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t mostSpots = 80; // with more it is no single row
constexpr double across = 0.15;       // of the smallest step: maximum distance of a spot from the line
constexpr double along = 0.08;        // of the period

// A period and the spots on it.
struct Period {
  double length = 0., origin = 0., rms = 0., score = 0.;
  int count = 0;
};

// Spots on a line, with their positions along it.
struct Line {
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  std::vector<std::pair<double, std::size_t>> places;
};

Line longestLine(const std::vector<vpLatticeSpot> &spots, double least)
{
  Line best;
  double bestLength = 0.;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    for (std::size_t j = i + 1; j < spots.size(); ++j) {
      const Eigen::Vector2d from(spots[i].x, spots[i].y), way = Eigen::Vector2d(spots[j].x, spots[j].y) - from;
      if (way.norm() < least) {
        continue;
      }
      Line line;
      line.direction = way.normalized();
      for (std::size_t k = 0; k < spots.size(); ++k) {
        const Eigen::Vector2d d = Eigen::Vector2d(spots[k].x, spots[k].y) - from;
        if (std::abs(d.x() * line.direction.y() - d.y() * line.direction.x()) < across * least) {
          line.places.emplace_back(d.dot(line.direction), k);
        }
      }
      const bool more = line.places.size() > best.places.size();
      if (more || (line.places.size() == best.places.size() && way.norm() > bestLength)) {
        best = line;
        bestLength = way.norm();
      }
    }
  }
  std::sort(best.places.begin(), best.places.end());
  return best;
}

// Least squares of origin and length from an initial value.
Period refine(const std::vector<std::pair<double, std::size_t>> &places, double length, double origin, double least)
{
  Period period;
  period.length = length;
  period.origin = origin;
  for (int round = 0; round < 3; ++round) {
    double n = 0., x = 0., xx = 0., y = 0., xy = 0., squares = 0.;
    for (const auto &[t, spot] : places) {
      const double c = std::round((t - period.origin) / period.length), e = t - period.origin - c * period.length;
      if (std::abs(e) < along * period.length) {
        n += 1.;
        x += c;
        xx += c * c;
        y += t;
        xy += c * t;
        squares += e * e;
      }
    }
    const double det = n * xx - x * x;
    const double next = det > 0. ? (n * xy - x * y) / det : 0.;
    period.count = static_cast<int>(n);
    period.rms = std::sqrt(squares / std::max(1., n));
    if (!(next >= least)) {
      break;
    }
    period.origin = (y - next * x) / n;
    period.length = next;
  }
  const double sites = (places.back().first - places.front().first) / period.length + 1.;
  period.score = period.count * std::sqrt(std::min(1., period.count / sites));
  return period;
}
} // namespace

vpLatticeFound vpSearchRow(const std::vector<vpLatticeSpot> &spots)
{
  vpLatticeFound found;
  if (spots.size() < 4 || spots.size() > mostSpots) {
    return found;
  }
  found.why = "most spots are on no common lattice";
  const double least = vpLeastStep(spots);
  const Line line = longestLine(spots, least);
  if (line.places.size() < 5) {
    return found;
  }
  Period best;
  for (std::size_t i = 0; i < line.places.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(line.places.size(), i + 4); ++j) {
      for (const double part : {1., 2., 3.}) {
        const double length = (line.places[j].first - line.places[i].first) / part;
        for (std::size_t k = 0; length >= least && k < line.places.size(); ++k) {
          const Period period = refine(line.places, length, line.places[k].first, least);
          best = period.count >= 5 && period.score > 1.02 * best.score ? period : best;
        }
      }
    }
  }
  if (best.count < 5 || best.count < 0.75 * static_cast<double>(line.places.size())) {
    return found;
  }
  found.kind = vpDotLatticeKind::Row;
  found.a = best.length * line.direction;
  found.rms = best.rms;
  found.occupancy = best.count / ((line.places.back().first - line.places.front().first) / best.length + 1.);
  double amplitude = 0.;
  for (const auto &[t, spot] : line.places) {
    const double column = std::round((t - best.origin) / best.length);
    if (std::abs(t - best.origin - column * best.length) < along * best.length) {
      found.spots.push_back(spot);
      found.rows.push_back(0);
      found.columns.push_back(static_cast<int>(column));
      amplitude += spots[spot].amplitude / best.count;
    }
  }
  found.score = best.count * std::sqrt(found.occupancy) * amplitude;
  return found;
}

END_VISP_NAMESPACE
