/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/rendering/vpProductPattern.h>

#include "vpHashRandom.h"
#include "vpProductOpenings.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpImage.h>
#include <visp3/rendering/vpProductPatternSpec.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
/*!
 * \brief Specks and cracks, from a hash of the 100 x 100 px tile of the product in which they lie (cracks: begin).
 */
class vpProductDirt
{
public:
  //! \brief A displacement of the product during the exposure and its fraction of the time.
  struct Instant {
    double x, y, share; // px
  };

  //! \param spec : Valid.
  explicit vpProductDirt(const vpProductPatternSpec &spec);

  /*!
   * Multiplies the image by the transmission of dust and cracks.
   * \param instants : The exposure, fractions add up to 1. \param image : Of the size in the specification.
   */
  void darken(const std::vector<Instant> &instants, vpImage<float> &image) const;

private:
  static constexpr int pieces = 4; // of a crack
  //! \brief A polyline of width 2 * half through the corners; a speck is an ellipse about the first corner.
  struct Mark {
    bool crack;
    std::array<double, pieces + 1> x, y; // px, product at (0, 0)
    double half;                         // width or semi-axis, px
    double stretch, cosine, sine;        // of a speck: ratio of second to first semi-axis, direction
    double opacity;
  };
  [[nodiscard]] std::vector<Mark> marksOf(int tileX, int tileY) const;
  [[nodiscard]] double shade(const Mark &mark, double x, double y) const;
  void darken(const Mark &mark, const std::vector<Instant> &instants, vpImage<float> &image) const;

  vpProductPatternSpec m_spec;
  double m_sigma; // blur of an edge by optics and pixel, px
};

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
