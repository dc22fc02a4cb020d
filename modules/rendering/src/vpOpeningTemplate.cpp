/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpOpeningTemplate.h"

#include "vpOpeningOutline.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

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

END_VISP_NAMESPACE
