/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpProductOpenings.h"

#include "vpHashRandom.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double keptShare = 0.2; // of the half length, beyond the centre, on the damaged side

// Fraction of an interval of length h that is inside, centred `distance` outside (> 0) or inside (< 0) an edge.
double inside(double distance, double h) { return std::clamp(0.5 - distance / h, 0., 1.); }
} // namespace

vpOpeningOutline::vpOpeningOutline(const vpProductPatternSpec &spec, vpOpeningDamage damage)
  : m_shape(spec.shape), m_a(spec.openingX / 2.), m_b(spec.openingY / 2.),
    m_radius(spec.shape == vpProductShape::Rounded ? spec.cornerRadius : 0.), m_cos(std::cos(spec.rotation)),
    m_sin(std::sin(spec.rotation)), m_left(damage == vpOpeningDamage::Left ? -keptShare * m_a : -m_a),
    m_right(damage == vpOpeningDamage::Right ? keptShare * m_a : m_a),
    m_upper(damage == vpOpeningDamage::Upper ? -keptShare * m_b : -m_b),
    m_lower(damage == vpOpeningDamage::Lower ? keptShare * m_b : m_b)
{
  const double c = std::fabs(m_cos);
  const double s = std::fabs(m_sin);
  if (m_shape == vpProductShape::Dot) {
    m_halfX = std::hypot(m_a * c, m_b * s);
    m_halfY = std::hypot(m_a * s, m_b * c);
  }
  else {
    m_halfX = (m_a - m_radius) * c + (m_b - m_radius) * s + m_radius;
    m_halfY = (m_a - m_radius) * s + (m_b - m_radius) * c + m_radius;
  }
}

double vpOpeningOutline::coverage(double x, double y, double h) const
{
  const double p = m_cos * x + m_sin * y; // along the row of cells
  const double q = m_cos * y - m_sin * x;
  // A rectangle is the product of its two intervals; this also closes the damaged side.
  const double rectangle =
      inside(m_left - p, h) * inside(p - m_right, h) * inside(m_upper - q, h) * inside(q - m_lower, h);
  if (rectangle <= 0.) {
    return 0.;
  }
  if (m_shape == vpProductShape::Dot) {
    const double f = p * p / (m_a * m_a) + q * q / (m_b * m_b) - 1.;
    const double slope = 2. * std::hypot(p / (m_a * m_a), q / (m_b * m_b));
    return std::min(rectangle, inside(slope > 0. ? f / slope : -m_b, h)); // distance to first order, exact at the edge
  }
  const double cornerX = std::fabs(p) - (m_a - m_radius);
  const double cornerY = std::fabs(q) - (m_b - m_radius);
  if (m_radius > 0. && cornerX > 0. && cornerY > 0.) {
    return std::min(rectangle, inside(std::hypot(cornerX, cornerY) - m_radius, h));
  }
  return rectangle;
}

namespace
{
constexpr double tail = 4.5; // beyond it the Gaussian counts as 0, standard deviations

// Gaussian and pixel area in one: the integral of the Gaussian over a pixel at distance t.
std::vector<double> blurKernel(double sigma, int steps)
{
  const int half = static_cast<int>(std::ceil((tail * sigma + 0.5) * steps));
  std::vector<double> kernel(2 * static_cast<std::size_t>(half) + 1);
  double sum = 0.;
  for (int n = -half; n <= half; ++n) {
    const double t = static_cast<double>(n) / steps;
    const double value = std::erf((t + 0.5) / (M_SQRT2 * sigma)) - std::erf((t - 0.5) / (M_SQRT2 * sigma));
    kernel[static_cast<std::size_t>(n) + static_cast<std::size_t>(half)] = value;
    sum += value;
  }
  for (double &value : kernel) {
    value /= sum;
  }
  return kernel;
}

// Convolves lines of n entries, `stride` apart, with the kernel; 0 outside.
void convolve(std::vector<float> &data, int lines, int lineStride, int n, int stride, const std::vector<double> &kernel)
{
  const std::size_t half = kernel.size() / 2;
  std::vector<double> padded(static_cast<std::size_t>(n) + kernel.size() - 1, 0.);
  for (int line = 0; line < lines; ++line) {
    float *const begin = data.data() + static_cast<std::size_t>(line) * lineStride;
    for (int i = 0; i < n; ++i) {
      padded[static_cast<std::size_t>(i) + half] = begin[static_cast<std::size_t>(i) * stride];
    }
    for (int i = 0; i < n; ++i) {
      double sum = 0.;
      for (std::size_t k = 0; k < kernel.size(); ++k) {
        sum += kernel[k] * padded[static_cast<std::size_t>(i) + k];
      }
      begin[static_cast<std::size_t>(i) * stride] = static_cast<float>(sum);
    }
  }
}

int floorDivide(int a, int b) { return a / b - (a % b < 0 ? 1 : 0); }
} // namespace

vpOpeningTemplate::vpOpeningTemplate(const vpProductPatternSpec &spec, vpOpeningDamage damage)
  : m_steps(std::max(spec.openingX, spec.openingY) <= 256. ? 8 : 4)
{
  const double h = 1. / m_steps;
  // The table starts with means over its mesh cells, which already are a small blur.
  const double sigma = std::sqrt(std::max(spec.psf * spec.psf - h * h / 12., h * h / 16.));
  const std::vector<double> kernel = blurKernel(sigma, m_steps);
  const vpOpeningOutline outline(spec, damage);
  const auto makeAxis = [&](double halfSize) {
    const double reach = halfSize + tail * sigma + 0.5;
    const int size = 2 * static_cast<int>(std::ceil(reach)) + 4; // one pixel on either side for the interpolation
    return Axis{reach, size, size * m_steps / 2};
  };
  m_x = makeAxis(outline.halfX());
  m_y = makeAxis(outline.halfY());

  const int nx = m_x.size * m_steps;
  const int ny = m_y.size * m_steps;
  std::vector<float> fine(static_cast<std::size_t>(nx) * ny);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      fine[static_cast<std::size_t>(j) * nx + i] =
          static_cast<float>(outline.coverage((i - m_x.middle) * h, (j - m_y.middle) * h, h));
    }
  }
  convolve(fine, ny, nx, nx, 1, kernel);
  convolve(fine, nx, 1, ny, nx, kernel);

  m_table.resize(fine.size());
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const std::size_t phase = static_cast<std::size_t>(j % m_steps) * m_steps + i % m_steps;
      const std::size_t entry = (phase * m_y.size + j / m_steps) * m_x.size + i / m_steps;
      m_table[entry] = fine[static_cast<std::size_t>(j) * nx + i];
    }
  }
}

vpOpeningTemplate::Taps vpOpeningTemplate::tapsFor(const Axis &axis, double centre, int imageSize) const
{
  Taps taps{};
  // Pixel k is at the node m_steps * (k - centre) + middle = m_steps * k + start.
  const double start = axis.middle - m_steps * centre;
  const int node = static_cast<int>(std::floor(start));
  const double f = start - node;
  // Lagrange's cubic through the nodes -1, 0, 1, 2.
  taps.weight[0] = -f * (f - 1.) * (f - 2.) / 6.;
  taps.weight[1] = (f + 1.) * (f - 1.) * (f - 2.) / 2.;
  taps.weight[2] = -(f + 1.) * f * (f - 2.) / 2.;
  taps.weight[3] = (f + 1.) * f * (f - 1.) / 6.;
  taps.first = 0;
  taps.last = imageSize;
  for (int j = 0; j < 4; ++j) {
    const int at = node - 1 + j;
    taps.shift[j] = floorDivide(at, m_steps);
    taps.phase[j] = at - m_steps * taps.shift[j];
    taps.first = std::max(taps.first, -taps.shift[j]);
    taps.last = std::min(taps.last, axis.size - taps.shift[j]);
  }
  return taps;
}

const float *vpOpeningTemplate::row(int phaseY, int phaseX, int entryY) const
{
  const std::size_t phase = static_cast<std::size_t>(phaseY) * m_steps + phaseX;
  return m_table.data() + (phase * m_y.size + entryY) * m_x.size;
}

void vpOpeningTemplate::add(double u, double v, double weight, vpImage<float> &image) const
{
  const Taps x = tapsFor(m_x, u, static_cast<int>(image.getWidth()));
  const Taps y = tapsFor(m_y, v, static_cast<int>(image.getHeight()));
  const int count = x.last - x.first;
  for (int k = y.first; k < y.last; ++k) {
    float *const out = image[k] + x.first;
    for (int j = 0; j < 4; ++j) {
      const float *in[4];
      float w[4];
      for (int i = 0; i < 4; ++i) {
        in[i] = row(y.phase[j], x.phase[i], k + y.shift[j]) + x.first + x.shift[i];
        w[i] = static_cast<float>(weight * y.weight[j] * x.weight[i]);
      }
      for (int c = 0; c < count; ++c) {
        out[c] += w[0] * in[0][c] + w[1] * in[1][c] + w[2] * in[2][c] + w[3] * in[3][c];
      }
    }
  }
}

namespace
{
constexpr double jitterCut = 3.; // standard deviations

double jitterOf(vpHashRandom &random, double sigma)
{
  const auto k = static_cast<std::uint16_t>(random.bits() >> 48);
  return sigma * std::clamp<double>(vpNormalQuantiles::get()[k], -jitterCut, jitterCut);
}

std::optional<vpOpeningDamage> openingOf(vpHashRandom &random, const vpProductPatternSpec &spec)
{
  constexpr vpOpeningDamage sides[] = {vpOpeningDamage::Left, vpOpeningDamage::Right, vpOpeningDamage::Upper,
                                       vpOpeningDamage::Lower};
  const double fate = random.uniform();
  const std::uint64_t side = random.bits() >> 62;
  if (fate < spec.missing) {
    return std::nullopt;
  }
  return fate < spec.missing + spec.damaged ? sides[side] : vpOpeningDamage::None;
}
} // namespace

vpProductLattice::vpProductLattice(const vpProductPatternSpec &spec)
  : m_spec(spec), m_cos(std::cos(spec.rotation)), m_sin(std::sin(spec.rotation))
{
  vpHashRandom random(spec.seed, vpHashRandom::Purpose::Flex, 0, 0);
  m_phaseX = random.uniform(0., 2. * M_PI);
  m_phaseY = random.uniform(0., 2. * M_PI);
}

vpProductLattice::Cell vpProductLattice::cell(int row, int column, double x, double y) const
{
  vpHashRandom random(m_spec.seed, vpHashRandom::Purpose::Cell, row, column);
  const double p = column * m_spec.pitchX + jitterOf(random, m_spec.jitter) +
                   m_spec.flexAmplitudeX * std::sin(2. * M_PI * column / m_spec.flexPeriodX + m_phaseX);
  const double q = row * m_spec.pitchY + jitterOf(random, m_spec.jitter) +
                   m_spec.flexAmplitudeY * std::sin(2. * M_PI * row / m_spec.flexPeriodY + m_phaseY);
  return {row, column, (m_spec.width - 1.) / 2. + x + (m_cos * p - m_sin * q),
          (m_spec.height - 1.) / 2. + y + (m_sin * p + m_cos * q), openingOf(random, m_spec)};
}

std::vector<vpProductLattice::Cell> vpProductLattice::cellsNear(double x, double y, double marginX,
                                                                double marginY) const
{
  const double halfU = m_spec.width / 2. + marginX;
  const double halfV = m_spec.height / 2. + marginY;
  // Bounding box of the rotated image in the axes of the product, plus the largest displacement of a cell.
  const double c = std::fabs(m_cos);
  const double s = std::fabs(m_sin);
  const double reachP = c * halfU + s * halfV + jitterCut * m_spec.jitter + m_spec.flexAmplitudeX;
  const double reachQ = s * halfU + c * halfV + jitterCut * m_spec.jitter + m_spec.flexAmplitudeY;
  const double p = -(m_cos * x + m_sin * y); // of the image's centre
  const double q = -(m_cos * y - m_sin * x);
  const auto first = [](double low, double pitch) { return static_cast<int>(std::floor(low / pitch)); };
  std::vector<Cell> cells;
  for (int row = first(q - reachQ, m_spec.pitchY); row * m_spec.pitchY <= q + reachQ; ++row) {
    for (int column = first(p - reachP, m_spec.pitchX); column * m_spec.pitchX <= p + reachP; ++column) {
      const Cell found = cell(row, column, x, y);
      const double u = found.u + 0.5;
      const double v = found.v + 0.5;
      if (u >= -marginX && u < m_spec.width + marginX && v >= -marginY && v < m_spec.height + marginY) {
        cells.push_back(found);
      }
    }
  }
  return cells;
}

END_VISP_NAMESPACE
