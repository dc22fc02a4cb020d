/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTemplateLearner.h"

#include "vpPatternSimd.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

BEGIN_VISP_NAMESPACE

using namespace vpCubicFilter;

namespace
{
const float splinePole = static_cast<float>(std::sqrt(3.) - 2.);

// Coefficients of the cubic B-spline through the values, in place: causal and anticausal recursion (Unser 1993).
void prefilter(float *values, int count)
{
  values[0] *= 6.F / (1.F - splinePole); // the border value is repeated
  for (int i = 1; i < count; ++i) {
    values[i] = 6.F * values[i] + splinePole * values[i - 1];
  }
  values[count - 1] /= 1.F - splinePole;
  for (int i = count - 2; i >= 0; --i) {
    values[i] = splinePole * (values[i + 1] - values[i]);
  }
}
} // namespace

vpTemplateLearner::vpTemplateLearner(std::size_t maxPixels) : m_capacity(maxPixels)
{
  m_window.resize(maxPixels);
  m_rowPass.resize(maxPixels);
  m_mean.resize(maxPixels);
  m_first.resize(medianCount * maxPixels);
  m_correction.resize(maxPixels);
  m_old.resize(maxPixels);
  m_coefficients.resize(maxPixels);
  m_scratch.resize(2 * maxPixels);
}

bool vpTemplateLearner::begin(int halfWidth, int halfHeight)
{
  m_hw = halfWidth;
  m_hh = halfHeight;
  m_count = 0;
  m_centreX = m_centreY = 0.;
  return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows() + 3) <= m_capacity;
}

void vpTemplateLearner::resample(const vpImage<unsigned char> &image, int ix, int iy, double fx, double fy)
{
  const int w = columns(), h = rows();
  const Taps tx = keys(fx), ty = keys(fy);
  for (int y = 0; y < h + 3; ++y) {
    for (int x = 0; x < w + 3; ++x) {
      m_scratch[static_cast<std::size_t>(x)] = clampedPixel(image, ix - 1 + x, iy - 1 + y);
    }
    filter(m_scratch.data(), w, 1, tx, &m_rowPass[static_cast<std::size_t>(y * w)]);
  }
  filter(m_rowPass.data(), w * h, w, ty, m_window.data());
}

// Normalise the window to the brightness and contrast of the first, so that the illumination does not spread the mean.
void vpTemplateLearner::normalise()
{
  const std::size_t n = static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows());
  double s = 0., q = 0.;
  for (std::size_t i = 0; i < n; ++i) {
    const double v = m_window[i];
    s += v;
    q += v * v;
  }
  const double level = s / static_cast<double>(n);
  const double contrast = std::sqrt(std::max(1., q / static_cast<double>(n) - level * level));
  if (m_count == 0) {
    m_level = level;
    m_contrast = contrast;
  }
  const float gain = static_cast<float>(m_contrast / contrast), offset = static_cast<float>(m_level - level * gain);
  for (std::size_t i = 0; i < n; ++i) {
    m_window[i] = m_window[i] * gain + offset;
  }
}

// The median of the first few windows, then a mean of values clipped to three deviations: robust to dust.
void vpTemplateLearner::mix()
{
  const std::size_t n = static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows());
  if (m_count < medianCount) {
    std::copy_n(m_window.begin(), n, m_first.begin() + m_count * static_cast<std::ptrdiff_t>(m_capacity));
    ++m_count;
    if (m_count < medianCount) {
      return;
    }
    double spread = 0.;
    for (std::size_t i = 0; i < n; ++i) {
      std::array<float, medianCount> v;
      for (std::size_t k = 0; k < medianCount; ++k) {
        v[k] = m_first[i + k * m_capacity];
      }
      std::sort(v.begin(), v.end());
      m_mean[i] = v[2];
      spread += v[3] - v[1]; // about one standard deviation
    }
    m_spread = static_cast<float>(spread / static_cast<double>(n)) + 0.5F;
    return;
  }
  ++m_count;
  const float share = 1.F / static_cast<float>(m_count), limit = 3.F * m_spread;
  float *__restrict mean = m_mean.data();
  const float *window = m_window.data();
  for (std::size_t i = 0; i < n; ++i) {
    const float d = window[i] - mean[i];
    mean[i] += share * std::min(limit, std::max(-limit, d));
  }
}

bool vpTemplateLearner::add(const vpImage<unsigned char> &image, double x, double y)
{
  const double fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx) - m_hw - margin, iy = static_cast<int>(fy) - m_hh - margin;
  if (x < m_hw || y < m_hh || x + m_hw + 1 > image.getWidth() || y + m_hh + 1 > image.getHeight()) {
    return false;
  }
  resample(image, ix, iy, x - fx, y - fy);
  normalise();
  mix();
  return true;
}

bool vpTemplateLearner::finish()
{
  m_limit = 3.F * m_spread;
  return m_count >= medianCount && makeSpline();
}

// For a half of the rows.
void vpTemplateLearner::coefficientsAlongRows(bool lower)
{
  const int w = columns(), begin = lower ? rows() / 2 : 0, end = lower ? rows() : rows() / 2;
  std::copy(m_mean.begin() + begin * w, m_mean.begin() + end * w, m_coefficients.begin() + begin * w);
  for (int r = begin; r < end; ++r) {
    prefilter(&m_coefficients[static_cast<std::size_t>(r * w)], w);
  }
}

// As prefilter(), all columns side by side.
void vpTemplateLearner::coefficientsAlongColumns()
{
  const int w = columns(), h = rows();
  float *c = m_coefficients.data();
  for (int x = 0; x < w; ++x) {
    c[x] *= 6.F / (1.F - splinePole);
  }
  for (int r = 1; r < h; ++r) {
    float *row = c + r * w;
    for (int x = 0; x < w; ++x) {
      row[x] = 6.F * row[x] + splinePole * row[x - w];
    }
  }
  float *last = c + (h - 1) * w;
  for (int x = 0; x < w; ++x) {
    last[x] /= 1.F - splinePole;
  }
  for (int r = h - 2; r >= 0; --r) {
    float *row = c + r * w;
    for (int x = 0; x < w; ++x) {
      row[x] = splinePole * (row[x + w] - row[x]);
    }
  }
}

// A cell is symmetric about its centre. The odd part of the mean is a shift, or an illumination gradient. For a half of
// the pixels, because the other half of the window has the same values with opposite sign.
void vpTemplateLearner::addSymmetry(bool lower)
{
  const int wide = 2 * m_hw + 1, n = wide * (2 * m_hh + 1), begin = lower ? n / 4 : 0, end = lower ? n / 2 : n / 4;
  const float *t = m_first.data(), *tx = t + m_capacity, *ty = tx + m_capacity;
  if (!lower) {
    m_normal = {};
    m_right = {};
  }
  for (int i = begin; i < end; ++i) {
    const int o = n - 1 - i;
    const double even = 0.5 * (t[i] + t[o]) - m_level, x = i % wide - m_hw, y = i / wide - m_hh;
    const double odd = 0.5 * (t[i] - t[o]);
    const std::array<double, unknowns> a = {0.5 * (tx[i] - tx[o]), 0.5 * (ty[i] - ty[o]), x, y, x * even, y * even};
    for (std::size_t k = 0; k < unknowns; ++k) {
      for (std::size_t l = 0; l < unknowns; ++l) {
        m_normal[k][l] += a[k] * a[l];
      }
      m_right[k] += a[k] * odd;
    }
  }
}

void vpTemplateLearner::centreOnSymmetry()
{
  using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const Vector6 odd =
      Eigen::Map<const Matrix6>(m_normal[0].data()).ldlt().solve(Eigen::Map<const Vector6>(m_right.data()));
  m_centreX -= odd[0];
  m_centreY -= odd[1];
  m_good = m_good && std::abs(m_centreX) < 1. && std::abs(m_centreY) < 1.;
  if (!m_good) {
    return;
  }
  // The slopes belong to the image, not to the cell.
  const int w = columns();
  const float gx = static_cast<float>(odd[2]), gy = static_cast<float>(odd[3]), level = static_cast<float>(m_level);
  const float hx = static_cast<float>(odd[4]), hy = static_cast<float>(odd[5]);
  for (int r = 0; r < rows(); ++r) {
    const float y = static_cast<float>(r - (m_hh + margin) - m_centreY);
    float *row = &m_mean[static_cast<std::size_t>(r * w)];
    for (int c = 0; c < w; ++c) {
      const float x = static_cast<float>(c - (m_hw + margin)) - static_cast<float>(m_centreX);
      row[c] -= gx * x + gy * y + (hx * x + hy * y) * (row[c] - level);
    }
  }
}

void vpTemplateLearner::beginSpline(int rounds)
{
  m_rounds = rounds;
  m_piece = 0;
  m_good = true;
}

// One round: coefficients, values and slopes, centre. At the end the coefficients again.
bool vpTemplateLearner::splinePiece()
{
  switch (m_piece++) {
  case 0:
    coefficientsAlongRows(false);
    return false;
  case 1:
    coefficientsAlongRows(true);
    return false;
  case 2:
    coefficientsAlongColumns();
    if (m_rounds == 0) {
      forgetResiduals();
      return true;
    }
    return false;
  case 3: // the first windows, or the residuals, are used up: their memory is reused
    evaluate(0., 0., m_first.data(), m_first.data() + m_capacity, m_first.data() + 2 * m_capacity);
    return false;
  case 4:
    addSymmetry(false);
    return false;
  case 5:
    addSymmetry(true);
    return false;
  default:
    centreOnSymmetry();
    --m_rounds;
    m_piece = 0;
    return !m_good;
  }
}

bool vpTemplateLearner::makeSpline()
{
  beginSpline(3);
  while (!splinePiece()) {
  }
  return m_good;
}

namespace
{
struct SplineTaps {
  Taps x, y, xs, ys;
};

// No member: of a function that is declared before, clang makes no copies.
VISP_PATTERN_CLONES void evaluateRows(const float *from, int stride, int columns, int rows, const SplineTaps &t,
                                      float *smooth, float *slope, float *value, float *dx, float *dy)
{
  for (int r = 0; r < rows; ++r, from += stride, value += columns, dx += columns, dy += columns) {
    filter(from, columns + 3, stride, t.y, smooth);
    filter(from, columns + 3, stride, t.ys, slope);
    filter(smooth, columns, 1, t.x, value);
    filter(smooth, columns, 1, t.xs, dx);
    filter(slope, columns, 1, t.x, dy);
  }
}
} // namespace

void vpTemplateLearner::evaluate(double px, double py, float *value, float *dx, float *dy) const
{
  evaluateOn(m_hw, m_hh, px, py, value, dx, dy);
}

void vpTemplateLearner::evaluateOn(int halfWidth, int halfHeight, double px, double py, float *value, float *dx,
                                   float *dy) const
{
  // Pixel u of the window shows the mean at u - p + centre.
  const double sx = m_centreX - px, sy = m_centreY - py, fx = std::floor(sx), fy = std::floor(sy);
  const SplineTaps taps = {spline(sx - fx), spline(sy - fy), splineSlope(sx - fx), splineSlope(sy - fy)};
  const int first = static_cast<int>(fx) + margin - 1 + m_hw - halfWidth;
  const int firstRow = static_cast<int>(fy) + margin - 1 + m_hh - halfHeight;
  evaluateRows(&m_coefficients[static_cast<std::size_t>(firstRow * columns() + first)], columns(), 2 * halfWidth + 1,
               2 * halfHeight + 1, taps, m_scratch.data(), m_scratch.data() + m_capacity, value, dx, dy);
}

END_VISP_NAMESPACE
