/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLatticeSearch.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>
#include <visp3/pattern/vpDotLattice.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int windows[] = {41, 21, 81, 161}; // px; the first that shows a lattice is used
constexpr double sizes[] = {1.7, 3.};        // factor of area: one size first; two shapes per period: two classes

constexpr std::size_t mostOfRow = 80; // spots; with more it is no single row
constexpr double across = 0.15;       // of the smallest step: maximum distance of a spot from the line
constexpr double along = 0.08;        // of the period

struct Candidate {
  vpLatticeFound found;
  std::vector<vpLatticeSpot> spots;
  bool bright = false;
};

// Equal lattice vectors, to a tenth.
bool isSame(const vpLatticeFound &p, const vpLatticeFound &q)
{
  const auto near = [](const Eigen::Vector2d &v, const Eigen::Vector2d &w) {
    return std::min((v - w).norm(), (v + w).norm()) <= 0.1 * w.norm();
  };
  return p.kind == q.kind && near(p.a, q.a) && near(p.b, q.b);
}

bool isBetter(const Candidate &candidate, const Candidate &best)
{
  const bool none = best.found.kind == vpDotLatticeKind::None;
  if (candidate.found.kind == vpDotLatticeKind::None) {
    return none && candidate.spots.size() > best.spots.size();
  }
  // In perspective distant dots, of another size, raise the rms, but belong to the lattice.
  const bool more = candidate.bright == best.bright && isSame(candidate.found, best.found) &&
                    candidate.found.spots.size() > best.found.spots.size();
  return none || more || candidate.found.score > best.found.score;
}

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

// One row: the line with most spots, then the period that most of them share; gaps do not matter.
vpLatticeFound searchRow(const std::vector<vpLatticeSpot> &spots)
{
  vpLatticeFound found;
  if (spots.size() < 4 || spots.size() > mostOfRow) {
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

// A row is selected when it explains most spots and the plane not clearly more.
vpLatticeFound search(const std::vector<vpLatticeSpot> &spots, const Eigen::Vector2d &middle)
{
  const vpLatticeFound plane = vpSearchLattice(spots, middle), row = searchRow(spots);
  const auto on = static_cast<double>(row.spots.size());
  const bool isRow = row.kind == vpDotLatticeKind::Row && on > 0.55 * static_cast<double>(spots.size());
  return isRow && (plane.kind == vpDotLatticeKind::None || on >= 0.8 * static_cast<double>(plane.spots.size())) ? row
                                                                                                                : plane;
}

// a points most nearly to the right, b is clockwise from it as seen (y is down).
void orient(vpLatticeFound &found)
{
  const auto flip = [](std::vector<int> &steps) {
    std::for_each(steps.begin(), steps.end(), [](int &step) { step = -step; });
  };
  if (found.kind == vpDotLatticeKind::Plane &&
      std::abs(found.b.x()) * found.a.norm() > std::abs(found.a.x()) * found.b.norm()) {
    std::swap(found.a, found.b);
    std::swap(found.rows, found.columns);
  }
  if (found.a.x() < 0.) {
    found.a = -found.a;
    flip(found.columns);
  }
  if (found.a.x() * found.b.y() - found.a.y() * found.b.x() < 0.) {
    found.b = -found.b;
    flip(found.rows);
  }
}

vpDotLattice latticeOf(const vpImage<unsigned char> &image, Candidate best)
{
  orient(best.found);
  vpDotLattice lattice;
  lattice.kind = best.found.kind;
  lattice.ax = best.found.a.x();
  lattice.ay = best.found.a.y();
  lattice.bx = best.found.b.x();
  lattice.by = best.found.b.y();
  lattice.spots = static_cast<int>(best.spots.size());
  lattice.bright = best.bright;
  lattice.rms = best.found.rms;
  lattice.occupancy = best.found.occupancy;
  for (std::size_t i = 0; i < best.found.spots.size(); ++i) {
    const vpLatticeSpot &spot = best.spots[best.found.spots[i]];
    vpPatternSpot edges = spot.box;
    const bool good = vpHalfMaximumCentre(image, {spot.level, 0., 0.}, edges);
    lattice.dots.push_back(
        {good ? edges.x : spot.x, good ? edges.y : spot.y, best.found.columns[i], best.found.rows[i]});
  }
  return lattice;
}

std::string messageOf(const vpDotLattice &lattice)
{
  char text[300];
  if (lattice.kind == vpDotLatticeKind::Plane) {
    std::snprintf(text, sizeof text,
                  "%zu of %d %s dots are on a %s lattice of %.4g and %.4g px, whose axes are at %.1f degrees.",
                  lattice.dots.size(), lattice.spots, lattice.bright ? "bright" : "dark", lattice.name(),
                  lattice.columnPitch(), lattice.rowPitch(), lattice.angle());
  }
  else {
    std::snprintf(text, sizeof text, "%zu of %d %s dots are in one row, %.4g px from each other.", lattice.dots.size(),
                  lattice.spots, lattice.bright ? "bright" : "dark", lattice.columnPitch());
  }
  return text;
}
} // namespace

double vpDotLattice::columnPitch() const { return std::hypot(ax, ay); }

double vpDotLattice::rowPitch() const { return std::hypot(bx, by); }

double vpDotLattice::angle() const
{
  return kind == vpDotLatticeKind::Plane ? vpMath::deg(std::atan2(ax * by - ay * bx, ax * bx + ay * by))
                                         : std::numeric_limits<double>::quiet_NaN();
}

const char *vpDotLattice::name() const
{
  if (kind != vpDotLatticeKind::Plane) {
    return kind == vpDotLatticeKind::Row ? "row" : "";
  }
  const bool equal = std::abs(std::log(columnPitch() / rowPitch())) < 0.03;
  const double skew = std::abs(angle() - 90.);
  if (skew < 2.) {
    return equal ? "square" : "rectangular";
  }
  if (equal) {
    return skew > 28. && skew < 32. ? "hexagonal" : "centred rectangular";
  }
  // The other basis of a centred lattice: the longer step ends half a shorter one aside.
  const double aside = std::abs(ax * bx + ay * by) / std::pow(std::min(columnPitch(), rowPitch()), 2);
  return std::abs(aside - 0.5) < 0.03 ? "centred rectangular" : "oblique";
}

vpDotLattice vpFindDotLattice(const vpImage<unsigned char> &image)
{
  if (image.getWidth() < 16 || image.getHeight() < 16) {
    throw vpException(vpException::badValue, "the image has %u x %u px, must have at least 16 x 16", image.getWidth(),
                      image.getHeight());
  }
  const Eigen::Vector2d middle(0.5 * (image.getWidth() - 1.), 0.5 * (image.getHeight() - 1.));
  Candidate best;
  for (const int window : windows) {
    vpLatticeSpots finder(image, window);
    for (const bool bright : {false, true}) {
      for (const double alike : sizes) {
        Candidate candidate;
        candidate.bright = bright;
        candidate.spots = finder.find(bright, alike);
        candidate.found = search(candidate.spots, middle);
        if (isBetter(candidate, best)) {
          best = std::move(candidate);
        }
      }
    }
    if (best.found.kind != vpDotLatticeKind::None) {
      break;
    }
  }
  if (best.found.kind == vpDotLatticeKind::None) {
    vpDotLattice none;
    none.spots = static_cast<int>(best.spots.size());
    none.message =
        "Of " + std::to_string(none.spots) + " spots of like size no lattice was found: " + best.found.why + ".";
    return none;
  }
  vpDotLattice lattice = latticeOf(image, std::move(best));
  lattice.message = messageOf(lattice);
  return lattice;
}

END_VISP_NAMESPACE
