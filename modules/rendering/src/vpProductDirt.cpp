/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpProductDirt.h"

#include "vpHashRandom.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double tile = 100.;       // px
constexpr double longestMark = 72.; // px from its start, without blur

// Number of marks in a tile; its mean over the tiles is the density.
int countOf(vpHashRandom &random, double density) { return static_cast<int>(std::floor(density + random.uniform())); }

double distanceToPiece(double x, double y, double ax, double ay, double bx, double by)
{
  const double dx = bx - ax;
  const double dy = by - ay;
  const double t = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0., 1.);
  return std::hypot(x - ax - t * dx, y - ay - t * dy);
}
} // namespace

vpProductDirt::vpProductDirt(const vpProductPatternSpec &spec)
  : m_spec(spec), m_sigma(std::sqrt(spec.psf * spec.psf + 1. / 12.))
{}

std::vector<vpProductDirt::Mark> vpProductDirt::marksOf(int tileX, int tileY) const
{
  std::vector<Mark> marks;
  vpHashRandom dust(m_spec.seed, vpHashRandom::Purpose::Dust, tileX, tileY);
  for (int k = countOf(dust, m_spec.dust); k > 0; --k) {
    Mark mark{};
    mark.x[0] = tile * (tileX + dust.uniform());
    mark.y[0] = tile * (tileY + dust.uniform());
    mark.half = dust.uniform(1., 2.5);
    mark.stretch = dust.uniform(1., 1.6);
    const double direction = dust.uniform(0., M_PI);
    mark.cosine = std::cos(direction);
    mark.sine = std::sin(direction);
    mark.opacity = dust.uniform(0.4, 1.);
    marks.push_back(mark);
  }
  vpHashRandom cracks(m_spec.seed, vpHashRandom::Purpose::Crack, tileX, tileY);
  for (int k = countOf(cracks, m_spec.cracks); k > 0; --k) {
    Mark mark{};
    mark.crack = true;
    mark.x[0] = tile * (tileX + cracks.uniform());
    mark.y[0] = tile * (tileY + cracks.uniform());
    mark.half = cracks.uniform(0.3, 0.8);
    mark.opacity = cracks.uniform(0.4, 0.9);
    double direction = cracks.uniform(0., 2. * M_PI);
    for (std::size_t i = 1; i <= pieces; ++i) {
      const double length = cracks.uniform(5., 17.5);
      mark.x[i] = mark.x[i - 1] + length * std::cos(direction);
      mark.y[i] = mark.y[i - 1] + length * std::sin(direction);
      direction += cracks.uniform(-0.7, 0.7);
    }
    marks.push_back(mark);
  }
  return marks;
}

// Light lost at a point of the product, after blur. Exact for straight edges that are long compared with the blur.
double vpProductDirt::shade(const Mark &mark, double x, double y) const
{
  const double scale = M_SQRT1_2 / m_sigma;
  if (!mark.crack) {
    const double p = mark.cosine * (x - mark.x[0]) + mark.sine * (y - mark.y[0]);
    const double q = (mark.cosine * (y - mark.y[0]) - mark.sine * (x - mark.x[0])) / mark.stretch;
    return mark.opacity * 0.5 * std::erfc((std::hypot(p, q) - mark.half) * scale);
  }
  double distance = INFINITY;
  for (std::size_t i = 0; i < pieces; ++i) {
    distance = std::min(distance, distanceToPiece(x, y, mark.x[i], mark.y[i], mark.x[i + 1], mark.y[i + 1]));
  }
  return mark.opacity * 0.5 * (std::erf((distance + mark.half) * scale) - std::erf((distance - mark.half) * scale));
}

void vpProductDirt::darken(const Mark &mark, const std::vector<Instant> &instants, vpImage<float> &image) const
{
  const std::size_t corners = mark.crack ? mark.x.size() : 1;
  const double reach = mark.half * std::max(mark.stretch, 1.) + 4.5 * m_sigma;
  const auto range = [&](const std::array<double, pieces + 1> &place, double Instant::*shift, unsigned int size,
                         int &first, int &last) {
    const auto [low, high] = std::minmax_element(place.begin(), place.begin() + static_cast<std::ptrdiff_t>(corners));
    const auto [early, late] = std::minmax_element(
        instants.begin(), instants.end(), [&](const Instant &a, const Instant &b) { return a.*shift < b.*shift; });
    first = static_cast<int>(std::max(std::ceil(*low + (*early).*shift - reach), 0.));
    last = static_cast<int>(std::min(std::floor(*high + (*late).*shift + reach), size - 1.));
  };
  int left = 0, right = 0, top = 0, bottom = 0;
  range(mark.x, &Instant::x, image.getWidth(), left, right);
  range(mark.y, &Instant::y, image.getHeight(), top, bottom);
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      double light = 1.;
      for (const Instant &now : instants) {
        light -= now.share * shade(mark, u - now.x, v - now.y);
      }
      image[v][u] *= static_cast<float>(light);
    }
  }
}

void vpProductDirt::darken(const std::vector<Instant> &instants, vpImage<float> &image) const
{
  if (m_spec.dust <= 0. && m_spec.cracks <= 0.) {
    return;
  }
  const double reach = longestMark + 4.5 * m_sigma;
  const auto range = [&](double Instant::*shift, unsigned int size, int &first, int &last) {
    const auto [early, late] = std::minmax_element(
        instants.begin(), instants.end(), [&](const Instant &a, const Instant &b) { return a.*shift < b.*shift; });
    first = static_cast<int>(std::floor((-reach - (*late).*shift) / tile));
    last = static_cast<int>(std::floor((size + reach - (*early).*shift) / tile));
  };
  int left = 0, right = 0, top = 0, bottom = 0;
  range(&Instant::x, image.getWidth(), left, right);
  range(&Instant::y, image.getHeight(), top, bottom);
  for (int tileY = top; tileY <= bottom; ++tileY) {
    for (int tileX = left; tileX <= right; ++tileX) {
      for (const Mark &mark : marksOf(tileX, tileY)) {
        darken(mark, instants, image);
      }
    }
  }
}

END_VISP_NAMESPACE
