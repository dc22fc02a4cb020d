/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/rendering/vpProductPattern.h>

#include <visp3/core/vpException.h>

#include "vpHashRandom.h"
#include "vpOpeningOutline.h"
#include "vpProductDirt.h"
#include "vpProductLattice.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double farthest = 1e8;      // px: beyond, the cell positions would lose digits
constexpr double longestBlur = 1000.; // px

void requireWithin(const char *name, double value, double limit, const char *unit)
{
  if (!(std::fabs(value) <= limit)) {
    throw vpException(vpException::badValue, "%s is %g %s, must be within +-%g", name, value, unit, limit);
  }
}

void requireDisplacement(double x, double y)
{
  requireWithin("displacement x", x, farthest, "px");
  requireWithin("displacement y", y, farthest, "px");
}

const vpProductPatternSpec &validated(const vpProductPatternSpec &spec)
{
  spec.validate();
  return spec;
}
} // namespace

class vpProductPattern::Impl
{
public:
  explicit Impl(const vpProductPatternSpec &s)
    : spec(validated(s)), lattice(spec), outline(spec, vpOpeningDamage::None), m_dirt(spec)
  {
    m_openings.emplace_back(spec, vpOpeningDamage::None);
    if (spec.damaged > 0.) { // in the order of the enumeration
      for (const vpOpeningDamage damage :
           {vpOpeningDamage::Left, vpOpeningDamage::Right, vpOpeningDamage::Upper, vpOpeningDamage::Lower}) {
        m_openings.emplace_back(spec, damage);
      }
    }
  }

  void expose(double x, double y, double vx, double vy, vpImage<float> &image) const
  {
    requireDisplacement(x, y);
    requireWithin("velocity x", vx, farthest, "px/frame");
    requireWithin("velocity y", vy, farthest, "px/frame");
    const double blurX = spec.exposure * vx;
    const double blurY = spec.exposure * vy;
    requireWithin("motion during the exposure", std::hypot(blurX, blurY), longestBlur, "px");
    const std::vector<vpProductDirt::Instant> instants = instantsOf(x, y, blurX, blurY);

    image.resize(spec.height, spec.width);
    image = static_cast<float>(spec.dark);
    const double contrast = spec.bright - spec.dark;
    const vpOpeningTemplate &largest = m_openings.front();
    for (const vpProductLattice::Cell &cell :
         lattice.cellsNear(x, y, largest.reachX() + std::fabs(blurX) / 2., largest.reachY() + std::fabs(blurY) / 2.)) {
      if (cell.opening) {
        const vpOpeningTemplate &opening = m_openings[static_cast<std::size_t>(*cell.opening)];
        for (const vpProductDirt::Instant &now : instants) {
          opening.add(cell.u + now.x - x, cell.v + now.y - y, contrast * now.share, image);
        }
      }
    }
    m_dirt.darken(instants, image);
    illuminate(image);
  }

  // Rows are independent of each other and of what was rendered before.
  void addNoise(unsigned int frame, const vpImage<float> &clean, vpImage<unsigned char> &noisy) const
  {
    const vpNormalQuantiles &normal = vpNormalQuantiles::get();
    const float floorVariance = 0.6F * 0.6F;
    const auto scale = static_cast<float>(spec.noise);
    noisy.resize(spec.height, spec.width);
    for (unsigned int v = 0; v < spec.height; ++v) {
      vpHashRandom random(spec.seed, vpHashRandom::Purpose::Noise, frame, v);
      std::uint64_t bits = 0;
      for (unsigned int u = 0; u < spec.width; ++u) {
        bits = u % 4 == 0 ? random.bits() : bits >> 16; // four numbers from one hash
        const float mean = clean[v][u];
        const float sigma = scale * std::sqrt(floorVariance + mean / 157.F);
        const float value = mean + sigma * normal[static_cast<std::uint16_t>(bits)];
        noisy[v][u] = static_cast<unsigned char>(std::clamp(value + 0.5F, 0.F, 255.F));
      }
    }
  }

  const vpProductPatternSpec spec;
  const vpProductLattice lattice;
  const vpOpeningOutline outline;

private:
  // Gauss quadrature with two points per pixel of motion: the image is smooth on that scale.
  static std::vector<vpProductDirt::Instant> instantsOf(double x, double y, double blurX, double blurY)
  {
    const double length = std::hypot(blurX, blurY);
    if (length < 1e-9) {
      return {{x, y, 1.}};
    }
    const int stretches = static_cast<int>(std::ceil(length));
    const double node = 0.5 / std::sqrt(3.);
    std::vector<vpProductDirt::Instant> instants;
    for (int k = 0; k < stretches; ++k) {
      for (const double offset : {0.5 - node, 0.5 + node}) {
        const double t = (k + offset) / stretches - 0.5;
        instants.push_back({x + blurX * t, y + blurY * t, 0.5 / stretches});
      }
    }
    return instants;
  }

  void illuminate(vpImage<float> &image) const
  {
    if (spec.illuminationX == 0. && spec.illuminationY == 0.) {
      return;
    }
    for (unsigned int v = 0; v < spec.height; ++v) {
      const double down = 1. + spec.illuminationY * (2. * v / (spec.height - 1.) - 1.);
      for (unsigned int u = 0; u < spec.width; ++u) {
        image[v][u] *= static_cast<float>(down + spec.illuminationX * (2. * u / (spec.width - 1.) - 1.));
      }
    }
  }

  std::vector<vpOpeningTemplate> m_openings; // indexed by vpOpeningDamage
  vpProductDirt m_dirt;
};

vpProductPattern::vpProductPattern(const vpProductPatternSpec &spec) : m_impl(std::make_shared<const Impl>(spec)) {}

const vpProductPatternSpec &vpProductPattern::spec() const { return m_impl->spec; }

void vpProductPattern::render(double x, double y, double vx, double vy, unsigned int frame,
                              vpImage<unsigned char> &I) const
{
  vpImage<float> clean;
  m_impl->expose(x, y, vx, vy, clean);
  m_impl->addNoise(frame, clean, I);
}

void vpProductPattern::expected(double x, double y, double vx, double vy, vpImage<float> &I) const
{
  m_impl->expose(x, y, vx, vy, I);
}

std::vector<vpPatternTruthCell> vpProductPattern::cells(double x, double y) const
{
  requireDisplacement(x, y);
  const double halfX = m_impl->outline.halfX();
  const double halfY = m_impl->outline.halfY();
  const double right = m_impl->spec.width - 0.5;
  const double bottom = m_impl->spec.height - 0.5;
  std::vector<vpPatternTruthCell> cells;
  for (const vpProductLattice::Cell &cell : m_impl->lattice.cellsNear(x, y, 0., 0.)) {
    const bool complete =
        cell.u - halfX >= -0.5 && cell.u + halfX <= right && cell.v - halfY >= -0.5 && cell.v + halfY <= bottom;
    cells.push_back({cell.row, cell.column, cell.u, cell.v, complete, cell.opening != vpOpeningDamage::None});
  }
  return cells;
}

END_VISP_NAMESPACE
