/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTemplateBank.h"

#include "vpPatternSimd.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
VISP_PATTERN_CLONES float dot(const float *a, const float *b, int n)
{
  float lanes[16] = {}; // partial sums, so that the compiler may use vectors without reordering a sum
  int i = 0;
  for (; i + 16 <= n; i += 16) {
    for (int k = 0; k < 16; ++k) {
      lanes[k] += a[i + k] * b[i + k];
    }
  }
  float sum = 0.F;
  for (; i < n; ++i) {
    sum += a[i] * b[i];
  }
  for (const float lane : lanes) {
    sum += lane;
  }
  return sum;
}

VISP_PATTERN_CLONES void subtract(float *__restrict a, float factor, const float *b, int n)
{
  for (int i = 0; i < n; ++i) {
    a[i] -= factor * b[i];
  }
}
} // namespace

vpTemplateBank::vpTemplateBank(std::size_t maxPixels)
  : m_capacity(maxPixels),
    m_room(static_cast<std::size_t>(maxPhases * basisSize) * (std::min<std::size_t>(maxPixels, 65536) + 32)),
    m_q(alignedRoom<std::int16_t>(m_room))
{
  m_basis.resize(basisSize * maxPixels);
}

void vpTemplateBank::begin(const vpTemplateLearner &learner)
{
  m_hw = learner.halfWidth();
  m_hh = learner.halfHeight();
  m_ready = 0;
  // Big cells take coarser phases; the Gauss-Newton step covers the rest.
  m_perAxis = finest;
  while (static_cast<std::size_t>(m_perAxis * m_perAxis * basisSize * stride()) > m_room && m_perAxis > 1) {
    m_perAxis /= 2;
  }
  m_phases = m_perAxis * m_perAxis;
}

bool vpTemplateBank::prepare(const vpTemplateLearner &learner, int count)
{
  for (; count > 0 && m_ready < m_phases; --count) {
    build(learner, m_ready);
    ++m_ready;
  }
  return isReady();
}

vpTemplateBank::Place vpTemplateBank::place(double x, double y) const
{
  // In steps of a phase, rounded and counted from the first phase of pixel 0; nothing negative can be in the image.
  const int bits = m_perAxis == 4 ? 2 : m_perAxis == 2 ? 1 : 0, half = m_perAxis / 2, mask = m_perAxis - 1;
  const int ix = static_cast<int>(x * m_perAxis + 0.5) + half, iy = static_cast<int>(y * m_perAxis + 0.5) + half;
  const int phaseX = ix & mask, phaseY = iy & mask;
  const double step = 1. / m_perAxis;
  Place p;
  p.x = ix >> bits;
  p.y = iy >> bits;
  p.phase = (phaseY << bits) + phaseX;
  p.px = p.x + (phaseX - half) * step;
  p.py = p.y + (phaseY - half) * step;
  return p;
}

void vpTemplateBank::build(const vpTemplateLearner &learner, int index)
{
  const int n = pixels(), columns = 2 * m_hw + 1, half = m_perAxis / 2;
  const std::size_t room = m_capacity;
  float *b[basisSize];
  for (std::size_t k = 0; k < basisSize; ++k) {
    b[k] = &m_basis[k * room];
  }
  learner.evaluate(static_cast<double>(index % m_perAxis - half) / m_perAxis,
                   static_cast<double>(index / m_perAxis - half) / m_perAxis, b[1], b[2], b[3]);
  const auto extremes = std::minmax_element(b[1], b[1] + n);
  m_range = *extremes.second - *extremes.first;
  double mean = 0.;
  for (int i = 0; i < n; ++i) {
    mean += b[1][i] / n;
  }
  for (int i = 0; i < n; ++i) {
    const float x = static_cast<float>(i % columns - m_hw), y = static_cast<float>(i / columns - m_hh);
    const float t = b[1][i] - static_cast<float>(mean); // the constant column takes the mean
    b[0][i] = 1.F;
    b[1][i] = t;
    b[4][i] = x;
    b[5][i] = y;
    b[6][i] = x * t;
    b[7][i] = y * t;
  }
  Phase &phase = m_phase[static_cast<std::size_t>(index)];
  auto &r = phase.r;
  r = {};
  for (std::size_t j = 0; j < basisSize; ++j) {
    for (int pass = 0; pass < 2; ++pass) { // twice is enough (Kahan)
      for (std::size_t k = 0; k < j; ++k) {
        const float projection = dot(b[k], b[j], n);
        r[k][j] += projection;
        subtract(b[j], projection, b[k], n);
      }
    }
    r[j][j] = std::sqrt(std::max(1e-12F, dot(b[j], b[j], n)));
    const float inverse = static_cast<float>(1. / r[j][j]);
    for (int i = 0; i < n; ++i) {
      b[j][i] *= inverse;
    }
  }
  std::int16_t *q = alignedBegin(m_q) + static_cast<std::ptrdiff_t>(index * basisSize) * stride();
  phase.q = q;
  for (std::size_t k = 0; k < basisSize; ++k) {
    float largest = 0.F;
    double sum = 0.;
    for (int i = 0; i < n; ++i) {
      largest = std::max(largest, std::abs(b[k][i]));
      sum += std::abs(b[k][i]);
    }
    // Neither a number nor the sum over pixels of +-256 may overflow.
    const float gain = static_cast<float>(std::min(32000. / largest, 2.1e9 / (256. * sum + 1.)));
    for (int i = 0; i < n; ++i) {
      q[i] = static_cast<std::int16_t>(std::lrint(b[k][i] * gain));
    }
    std::fill(q + n, q + stride(), static_cast<std::int16_t>(0));
    phase.scale[k] = 1.F / gain;
    q += stride();
  }
}

END_VISP_NAMESPACE
