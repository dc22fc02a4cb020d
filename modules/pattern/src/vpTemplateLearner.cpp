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

namespace
{
using Taps = std::array<float, 4>;

// Interpolation by a cubic of third order (Keys 1981) between the second and the third of four neighbours.
Taps keys(double f)
{
  return {static_cast<float>(((-0.5 * f + 1.) * f - 0.5) * f), static_cast<float>((1.5 * f - 2.5) * f * f + 1.),
          static_cast<float>(((-1.5 * f + 2.) * f + 0.5) * f), static_cast<float>((0.5 * f - 0.5) * f * f)};
}

// Cubic B-spline and its derivative.
Taps spline(double f)
{
  const double g = 1. - f;
  return {static_cast<float>(g * g * g / 6.), static_cast<float>((4. - 6. * f * f + 3. * f * f * f) / 6.),
          static_cast<float>((4. - 6. * g * g + 3. * g * g * g) / 6.), static_cast<float>(f * f * f / 6.)};
}

Taps splineSlope(double f)
{
  const double g = 1. - f;
  return {static_cast<float>(-0.5 * g * g), static_cast<float>(-2. * f + 1.5 * f * f),
          static_cast<float>(2. * g - 1.5 * g * g), static_cast<float>(0.5 * f * f)};
}

// to[i] = sum of t[k] from[i + k * stride]
void filter(const float *from, int count, int stride, const Taps &t, float *__restrict to)
{
  for (int i = 0; i < count; ++i) {
    to[i] = t[0] * from[i] + t[1] * from[i + stride] + t[2] * from[i + 2 * stride] + t[3] * from[i + 3 * stride];
  }
}

// The border of the image goes on for ever: only what is around the window of a cell may lie out there.
float clampedPixel(const vpImage<unsigned char> &image, int x, int y)
{
  return static_cast<float>(image[static_cast<unsigned int>(std::clamp(y, 0, static_cast<int>(image.getHeight()) - 1))]
                                 [static_cast<unsigned int>(std::clamp(x, 0, static_cast<int>(image.getWidth()) - 1))]);
}

// Coefficients of the cubic B-spline through the values, in place: causal and anticausal recursion (Unser 1993).
void prefilter(float *values, int count, int stride)
{
  const float pole = static_cast<float>(std::sqrt(3.) - 2.);
  values[0] *= 6.F / (1.F - pole); // the border value goes on for ever
  for (int i = 1; i < count; ++i) {
    values[i * stride] = 6.F * values[i * stride] + pole * values[(i - 1) * stride];
  }
  values[(count - 1) * stride] /= 1.F - pole;
  for (int i = count - 2; i >= 0; --i) {
    values[i * stride] = pole * (values[(i + 1) * stride] - values[i * stride]);
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

// Bring the window to the brightness and contrast of the first, so that the illumination does not spread the mean.
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

// The median of the first few windows, then a mean of values clipped to three deviations: dust leaves no mark.
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

bool vpTemplateLearner::finish() { return m_count >= medianCount && makeSpline(); }

void vpTemplateLearner::makeCoefficients()
{
  const int w = columns(), h = rows();
  m_coefficients = m_mean; // of the same size: no allocation
  for (int r = 0; r < h; ++r) {
    prefilter(&m_coefficients[static_cast<std::size_t>(r * w)], w, 1);
  }
  for (int c = 0; c < w; ++c) {
    prefilter(&m_coefficients[static_cast<std::size_t>(c)], h, w);
  }
}

bool vpTemplateLearner::makeSpline()
{
  // A cell is symmetric about its centre. What is odd in the mean is a shift, or a slope of the illumination.
  const int w = columns(), wide = 2 * m_hw + 1, n = wide * (2 * m_hh + 1);
  const float *t = m_first.data(), *tx = t + m_capacity, *ty = tx + m_capacity; // the first windows are used up
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Vector6 odd = Vector6::Zero();
  for (int round = 0; round < 3; ++round) {
    makeCoefficients();
    evaluate(0., 0., m_first.data(), m_first.data() + m_capacity, m_first.data() + 2 * m_capacity);
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Vector6 right = Vector6::Zero();
    for (int i = 0; i < n; ++i) {
      const int o = n - 1 - i;
      const double even = 0.5 * (t[i] + t[o]) - m_level, x = i % wide - m_hw, y = i / wide - m_hh;
      Vector6 a;
      a << 0.5 * (tx[i] - tx[o]), 0.5 * (ty[i] - ty[o]), x, y, x * even, y * even;
      normal.noalias() += a * a.transpose();
      right += a * (0.5 * (t[i] - t[o]));
    }
    odd = normal.ldlt().solve(right);
    m_centreX -= odd[0];
    m_centreY -= odd[1];
    if (!(std::abs(m_centreX) < 1. && std::abs(m_centreY) < 1.)) {
      return false;
    }
    // The slopes are the image's, not the cell's.
    for (int r = 0; r < rows(); ++r) {
      for (int c = 0; c < w; ++c) {
        const double x = c - (m_hw + margin) - m_centreX, y = r - (m_hh + margin) - m_centreY;
        float &v = m_mean[static_cast<std::size_t>(r * w + c)];
        v -= static_cast<float>(odd[2] * x + odd[3] * y + (odd[4] * x + odd[5] * y) * (v - m_level));
      }
    }
  }
  makeCoefficients();
  m_residuals = 0;
  std::fill(m_correction.begin(), m_correction.end(), 0.F);
  return true;
}

bool vpTemplateLearner::addResidual(const vpImage<unsigned char> &image, double x, double y)
{
  const int ix = static_cast<int>(std::floor(x + 0.5)), iy = static_cast<int>(std::floor(y + 0.5));
  const int hw = m_hw + extra, hh = m_hh + extra, wide = 2 * hw + 1, high = 2 * hh + 1, n = wide * high;
  if (ix < m_hw || iy < m_hh || ix + m_hw >= static_cast<int>(image.getWidth()) ||
      iy + m_hh >= static_cast<int>(image.getHeight())) {
    return false;
  }
  // The first windows are not needed any more: their room serves for the model and its slopes.
  float *model = m_first.data();
  evaluateOn(hw, hh, x - ix, y - iy, model, model + m_capacity, model + 2 * m_capacity);
  double sm = 0., si = 0., smm = 0., smi = 0.;
  for (int i = 0; i < n; ++i) {
    const double m = model[i], v = clampedPixel(image, ix - hw + i % wide, iy - hh + i / wide);
    sm += m;
    si += v;
    smm += m * m;
    smi += m * v;
  }
  const double gain = (smi - sm * si / n) / std::max(1., smm - sm * sm / n), offset = (si - gain * sm) / n;
  if (gain < 0.2) {
    return false;
  }
  float *rest = model + m_capacity, *padded = rest + m_capacity;
  const float limit = 3.F * m_spread;
  for (int i = 0; i < n; ++i) {
    const double v = clampedPixel(image, ix - hw + i % wide, iy - hh + i / wide);
    rest[i] = std::clamp(static_cast<float>((v - offset) / gain) - model[i], -limit, limit);
  }
  // Shift what is left over back onto the grid of the template; beyond the window the nearest value stands in.
  const int w = columns(), h = rows(), room = w * (h + 3);
  const double sx = ix - x + m_centreX, sy = iy - y + m_centreY; // pixel u shows the template at u + s
  const int dx = static_cast<int>(std::ceil(sx)), dy = static_cast<int>(std::ceil(sy));
  const double fx = dx - sx, fy = dy - sy;
  for (int r = 0; r < h + 3; ++r) {
    const int from = std::clamp(r - margin + extra - 1 - dy, 0, high - 1) * wide;
    for (int c = 0; c < w; ++c) {
      padded[r * w + c] = rest[from + std::clamp(c - margin + extra - 1 - dx, 0, wide - 1)];
    }
  }
  const Taps tx = keys(fx), ty = keys(fy);
  filter(padded, room - 3, 1, tx, m_rowPass.data());
  filter(m_rowPass.data(), w * h - 3, w, ty, m_window.data());
  for (int i = 0; i < w * h - 3; ++i) {
    m_correction[static_cast<std::size_t>(i)] += m_window[static_cast<std::size_t>(i)];
  }
  ++m_residuals;
  return true;
}

bool vpTemplateLearner::refine()
{
  const float share = 1.F / static_cast<float>(std::max(1, m_residuals));
  for (std::size_t i = 0; i < m_mean.size(); ++i) {
    m_mean[i] += share * m_correction[i];
  }
  return makeSpline();
}

void vpTemplateLearner::evaluate(double px, double py, float *value, float *dx, float *dy) const
{
  evaluateOn(m_hw, m_hh, px, py, value, dx, dy);
}

VISP_PATTERN_CLONES void vpTemplateLearner::evaluateOn(int halfWidth, int halfHeight, double px, double py,
                                                       float *value, float *dx, float *dy) const
{
  // Pixel u of the window shows the mean at u - p + centre.
  const double sx = m_centreX - px, sy = m_centreY - py, fx = std::floor(sx), fy = std::floor(sy);
  const Taps x = spline(sx - fx), y = spline(sy - fy), xs = splineSlope(sx - fx), ys = splineSlope(sy - fy);
  const int w = columns(), columnsOut = 2 * halfWidth + 1, rowsOut = 2 * halfHeight + 1;
  const int first = static_cast<int>(fx) + margin - 1 + m_hw - halfWidth;
  const int firstRow = static_cast<int>(fy) + margin - 1 + m_hh - halfHeight;
  float *smooth = m_scratch.data(), *slope = m_scratch.data() + m_capacity;
  for (int r = 0; r < rowsOut; ++r) {
    const float *from = &m_coefficients[static_cast<std::size_t>((r + firstRow) * w + first)];
    filter(from, columnsOut + 3, w, y, smooth);
    filter(from, columnsOut + 3, w, ys, slope);
    filter(smooth, columnsOut, 1, x, value + r * columnsOut);
    filter(smooth, columnsOut, 1, xs, dx + r * columnsOut);
    filter(slope, columnsOut, 1, x, dy + r * columnsOut);
  }
}

END_VISP_NAMESPACE
