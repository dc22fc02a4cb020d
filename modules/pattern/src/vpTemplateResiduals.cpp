/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Residuals of a template at the cells, collected and added back to it.
#include "vpTemplateLearner.h"

#include "vpPatternSimd.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

using namespace vpCubicFilter;

namespace
{
// Pixels become the residuals of the model, fitted in brightness and contrast, clipped. False: it does not fit at all.
VISP_PATTERN_CLONES bool toResiduals(const float *model, float *__restrict pixels, int n, float limit)
{
  constexpr int lanes = 8; // partial sums, so that the compiler may use vectors without reordering a sum
  float m[lanes] = {}, v[lanes] = {}, mm[lanes] = {}, mv[lanes] = {};
  const float origin = model[0], shade = pixels[0]; // keeps the sums small
  int i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (int k = 0; k < lanes; ++k) {
      const float a = model[i + k] - origin, b = pixels[i + k] - shade;
      m[k] += a;
      v[k] += b;
      mm[k] += a * a;
      mv[k] += a * b;
    }
  }
  for (; i < n; ++i) {
    const float a = model[i] - origin, b = pixels[i] - shade;
    m[0] += a;
    v[0] += b;
    mm[0] += a * a;
    mv[0] += a * b;
  }
  double sm = 0., sv = 0., smm = 0., smv = 0.;
  for (int k = 0; k < lanes; ++k) {
    sm += m[k];
    sv += v[k];
    smm += mm[k];
    smv += mv[k];
  }
  const double gain = (smv - sm * sv / n) / std::max(1., smm - sm * sm / n);
  if (!(gain > 0.2)) {
    return false;
  }
  const double offset = shade + (sv - gain * sm) / n - gain * origin;
  const float scale = static_cast<float>(1. / gain), shift = static_cast<float>(-offset / gain);
  for (i = 0; i < n; ++i) {
    const float rest = pixels[i] * scale + shift - model[i];
    const float low = rest < -limit ? -limit : rest;
    pixels[i] = low > limit ? limit : low;
  }
  return true;
}
} // namespace

void vpTemplateLearner::forgetResiduals()
{
  m_residuals = 0;
  std::fill_n(m_correction.begin(), used(), 0.F);
}

bool vpTemplateLearner::addResidual(const vpImage<unsigned char> &image, double x, double y)
{
  const int ix = static_cast<int>(std::floor(x + 0.5)), iy = static_cast<int>(std::floor(y + 0.5));
  const int hw = m_hw + extra, hh = m_hh + extra, wide = 2 * hw + 1, high = 2 * hh + 1, n = wide * high;
  if (ix < m_hw || iy < m_hh || ix + m_hw >= static_cast<int>(image.getWidth()) ||
      iy + m_hh >= static_cast<int>(image.getHeight())) {
    return false;
  }
  // The first windows are not needed any more: their memory is used for the model and its slopes.
  float *model = m_first.data(), *rest = model + m_capacity, *padded = rest + m_capacity;
  evaluateOn(hw, hh, x - ix, y - iy, model, rest, padded);
  const bool inside = ix >= hw && iy >= hh && ix + hw < static_cast<int>(image.getWidth()) &&
                      iy + hh < static_cast<int>(image.getHeight());
  for (int r = 0; r < high; ++r) {
    float *to = rest + r * wide;
    if (inside) {
      std::copy_n(image[static_cast<unsigned int>(iy - hh + r)] + (ix - hw), wide, to);
      continue;
    }
    for (int c = 0; c < wide; ++c) {
      to[c] = clampedPixel(image, ix - hw + c, iy - hh + r);
    }
  }
  if (!toResiduals(model, rest, n, m_limit)) {
    return false;
  }
  // Shift the residuals back onto the grid of the template; beyond the window the nearest value is used.
  const int w = columns(), h = rows(), room = w * (h + 3);
  const double sx = ix - x + m_centreX, sy = iy - y + m_centreY; // pixel u shows the template at u + s
  const int dx = static_cast<int>(std::ceil(sx)), dy = static_cast<int>(std::ceil(sy));
  const double fx = dx - sx, fy = dy - sy;
  for (int r = 0; r < h + 3; ++r) {
    const float *from = rest + std::clamp(r - margin + extra - 1 - dy, 0, high - 1) * wide;
    const int shift = margin - extra + 1 + dx, first = std::clamp(shift, 0, w), last = std::clamp(shift + wide, 0, w);
    float *to = padded + r * w;
    std::fill(to, to + first, from[0]);
    std::copy(from + (first - shift), from + (last - shift), to + first);
    std::fill(to + last, to + w, from[wide - 1]);
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
  beginRefine(1.);
  return makeSpline();
}

double vpTemplateLearner::misfit() const
{
  const int w = columns();
  double sum = 0.;
  for (int r = margin; r <= margin + 2 * m_hh; ++r) {
    for (int c = margin; c <= margin + 2 * m_hw; ++c) {
      const double v = m_correction[static_cast<std::size_t>(r * w + c)];
      sum += v * v;
    }
  }
  return sum / ((2. * m_hw + 1.) * (2. * m_hh + 1.) * std::max(1, m_residuals));
}

void vpTemplateLearner::beginRefine(double share)
{
  std::copy_n(m_mean.begin(), used(), m_old.begin());
  m_oldCentreX = m_centreX;
  m_oldCentreY = m_centreY;
  const float factor = static_cast<float>(share / std::max(1, m_residuals));
  for (std::size_t i = 0; i < used(); ++i) {
    m_mean[i] += factor * m_correction[i];
  }
  beginSpline(2); // from a nearly correct centre
}

bool vpTemplateLearner::refinePiece() { return splinePiece(); }

void vpTemplateLearner::beginRestore()
{
  std::copy_n(m_old.begin(), used(), m_mean.begin());
  m_centreX = m_oldCentreX;
  m_centreY = m_oldCentreY;
  beginSpline(0);
}

END_VISP_NAMESPACE
