/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTemplateBank.h"

#include "vpPatternSimd.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
// Round to 16 bits; returns the value of one step. Neither a number nor the sum over pixels of +-256 may overflow.
VISP_PATTERN_CLONES float toIntegers(const float *b, int n, std::int16_t *__restrict q)
{
  constexpr int lanes = 16; // so that the compiler may use vectors without reordering a sum
  float largest[lanes] = {}, sums[lanes] = {};
  int i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (int k = 0; k < lanes; ++k) {
      const float v = std::abs(b[i + k]);
      largest[k] = v > largest[k] ? v : largest[k];
      sums[k] += v;
    }
  }
  for (; i < n; ++i) {
    largest[0] = std::max(largest[0], std::abs(b[i]));
    sums[0] += std::abs(b[i]);
  }
  const float most = *std::max_element(largest, largest + lanes);
  const double sum = std::accumulate(sums, sums + lanes, 0.);
  const float gain = static_cast<float>(std::min(32000. / most, 2.1e9 / (256. * sum + 1.)));
  for (i = 0; i < n; ++i) {
    const float v = b[i] * gain;
    q[i] = static_cast<std::int16_t>(static_cast<std::int32_t>(v + (v < 0.F ? -0.5F : 0.5F)));
  }
  return 1.F / gain;
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
  m_ready = m_piece = 0;
  // Large cells use coarser phases; the Gauss-Newton step covers the rest.
  m_perAxis = finest;
  while (static_cast<std::size_t>(m_perAxis * m_perAxis * basisSize * stride()) > m_room && m_perAxis > 1) {
    m_perAxis /= 2;
  }
  m_phases = m_perAxis * m_perAxis;
}

bool vpTemplateBank::prepare(const vpTemplateLearner &learner, int count)
{
  for (; count > 0 && m_ready < m_phases; --count) {
    for (int piece = 0; piece < piecesPerPhase; ++piece) {
      static_cast<void>(preparePiece(learner));
    }
  }
  return isReady();
}

bool vpTemplateBank::preparePiece(const vpTemplateLearner &learner)
{
  if (m_ready == m_phases) {
    return isReady();
  }
  switch (m_piece) {
  case 0:
    fillBasis(learner, m_ready);
    break;
  case 1:
    orthogonalise(m_ready, 0, 6);
    break;
  case 2:
    orthogonalise(m_ready, 6, basisSize);
    break;
  default:
    quantise(m_ready);
    break;
  }
  if (++m_piece == piecesPerPhase) {
    m_piece = 0;
    ++m_ready;
  }
  return isReady();
}

vpTemplateBank::Place vpTemplateBank::place(double x, double y) const
{
  // In steps of a phase, rounded and counted from the first phase of pixel 0; image coordinates are never negative.
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

void vpTemplateBank::fillBasis(const vpTemplateLearner &learner, int index)
{
  const int n = pixels(), columns = 2 * m_hw + 1, half = m_perAxis / 2;
  float *const one = column(0), *const value = column(1), *const x = column(4), *const y = column(5);
  float *const xt = column(6), *const yt = column(7);
  learner.evaluate(static_cast<double>(index % m_perAxis - half) / m_perAxis,
                   static_cast<double>(index / m_perAxis - half) / m_perAxis, value, column(2), column(3));
  const auto extremes = std::minmax_element(value, value + n);
  m_range = *extremes.second - *extremes.first;
  double sum = 0.;
  for (int i = 0; i < n; ++i) {
    sum += value[i];
  }
  const float mean = static_cast<float>(sum / n); // the constant column takes it
  for (int row = 0, i = 0; row <= 2 * m_hh; ++row) {
    const float v = static_cast<float>(row - m_hh);
    for (int c = 0; c < columns; ++c, ++i) {
      const float u = static_cast<float>(c - m_hw), t = value[i] - mean;
      one[i] = 1.F;
      value[i] = t;
      x[i] = u;
      y[i] = v;
      xt[i] = u * t;
      yt[i] = v * t;
    }
  }
  m_phase[static_cast<std::size_t>(index)].r = {};
}

// Gram-Schmidt for the columns from \e from on, before \e end.
void vpTemplateBank::orthogonalise(int index, std::size_t from, std::size_t end)
{
  const int n = pixels();
  Phase &phase = m_phase[static_cast<std::size_t>(index)];
  auto &r = phase.r;
  for (std::size_t j = from; j < end; ++j) {
    float *const b = column(j);
    for (int pass = 0; pass < 2; ++pass) { // twice is enough (Kahan)
      for (std::size_t k = 0; k < j; ++k) {
        const float projection = dot(column(k), b, n);
        r[k][j] += projection;
        subtract(b, projection, column(k), n);
      }
    }
    r[j][j] = std::sqrt(std::max(1e-12F, dot(b, b, n)));
    const float inverse = static_cast<float>(1. / r[j][j]);
    for (int i = 0; i < n; ++i) {
      b[i] *= inverse;
    }
  }
  for (std::size_t k = 0; k < phase.inverse.size(); ++k) {
    phase.inverse[k] = 1. / r[k][k];
  }
  // Of the inverse of R two by two, x and y.
  const double ix = phase.inverse[2], iy = phase.inverse[3];
  phase.yy = iy * iy;
  phase.xx = ix * ix * (1. + r[2][3] * r[2][3] * iy * iy);
}

void vpTemplateBank::quantise(int index)
{
  const int n = pixels();
  Phase &phase = m_phase[static_cast<std::size_t>(index)];
  std::int16_t *q = alignedBegin(m_q) + static_cast<std::ptrdiff_t>(index * basisSize) * stride();
  phase.q = q;
  for (std::size_t k = 0; k < basisSize; ++k) {
    phase.scale[k] = toIntegers(column(k), n, q);
    std::fill(q + n, q + stride(), static_cast<std::int16_t>(0));
    q += stride();
  }
}

END_VISP_NAMESPACE
