/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCellAligner.h"

#include "vpPatternSimd.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int size = vpTemplateBank::basisSize;
constexpr int maxSteps = 10;    // one, or two, unless the motion has changed a lot
constexpr int unknowns = 4;     // rows of the basis for brightness, contrast, x and y; the slopes come after them
constexpr double maxStep = 1.5; // px: the template contains no information farther away
// Where more than half of the information of a side of a cell about its axis is hidden, the other edge may belong to
// another object of similar grey value, and the other pixels would agree with it.
constexpr double mostHidden = 0.5;

// sums[k] = row k of q times w, for rows that share the loaded part of w. All numbers are 16 bits wide and the sums 32:
// the compiler multiplies and adds pairs.
struct StepSums {
  std::int64_t contrast, x, y, brightness, energy;
};
VISP_PATTERN_CLONES StepSums stepProducts(const std::int16_t *q0, const std::int16_t *q1, const std::int16_t *w, int n)
{
  constexpr int most = 65536; // squares of 8-bit numbers fit into 32 bits
  const std::int16_t *q2 = q1 + n, *q3 = q2 + n;
  StepSums sums{0, 0, 0, 0, 0};
  for (int begin = 0; begin < n; begin += most) {
    const int end = std::min(n, begin + most);
    std::int32_t s0 = 0, s1 = 0, s2 = 0, s3 = 0, squares = 0;
    for (int i = begin; i < end; ++i) {
      const std::int32_t v = w[i];
      s0 += static_cast<std::int32_t>(q0[i]) * v;
      s1 += static_cast<std::int32_t>(q1[i]) * v;
      s2 += static_cast<std::int32_t>(q2[i]) * v;
      s3 += static_cast<std::int32_t>(q3[i]) * v;
      squares += v * v;
    }
    sums.brightness += s0;
    sums.contrast += s1;
    sums.x += s2;
    sums.y += s3;
    sums.energy += squares;
  }
  return sums;
}

VISP_PATTERN_CLONES void fourProducts(const std::int16_t *q, const std::int16_t *w, int n, std::int32_t *sums)
{
  const std::int16_t *q1 = q + n, *q2 = q1 + n, *q3 = q2 + n;
  std::int32_t s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  for (int i = 0; i < n; ++i) {
    const std::int32_t v = w[i];
    s0 += static_cast<std::int32_t>(q[i]) * v;
    s1 += static_cast<std::int32_t>(q1[i]) * v;
    s2 += static_cast<std::int32_t>(q2[i]) * v;
    s3 += static_cast<std::int32_t>(q3[i]) * v;
  }
  sums[0] = s0;
  sums[1] = s1;
  sums[2] = s2;
  sums[3] = s3;
}

double scaled(const vpTemplateBank::Phase &phase, int row, std::int64_t sum)
{
  return static_cast<double>(phase.scale[static_cast<std::size_t>(row)]) * static_cast<double>(sum);
}

// z = Q' w for brightness, contrast, x and y; returns |w|^2. The row of the brightness is one number, the same in all
// phases: the first phase's row stays in the cache.
double projectStep(const vpTemplateBank &bank, const vpTemplateBank::Phase &phase, const std::int16_t *w, double *z)
{
  const vpTemplateBank::Phase &first = bank.phase(0);
  const StepSums sums = stepProducts(first.q, phase.q + bank.stride(), w, bank.stride());
  z[0] = scaled(first, 0, sums.brightness);
  z[1] = scaled(phase, 1, sums.contrast);
  z[2] = scaled(phase, 2, sums.x);
  z[3] = scaled(phase, 3, sums.y);
  return static_cast<double>(sums.energy);
}

// z = Q' w for the slopes.
void projectSlopes(const vpTemplateBank::Phase &phase, const std::int16_t *w, int stride, double *z)
{
  std::int32_t sums[4];
  fourProducts(phase.q + unknowns * stride, w, stride, sums);
  for (int k = 0; k < 4; ++k) {
    z[unknowns + k] = scaled(phase, unknowns + k, sums[k]);
  }
}

// The window, row after row without gaps. All rows but the last are written in whole vectors: the excess comes from the
// row below in the image and is overwritten by the next row.
VISP_PATTERN_CLONES void toWindow(const unsigned char *from, std::ptrdiff_t stride, int columns, int rows,
                                  std::int16_t *__restrict to)
{
  constexpr int vector = 16;
  for (int r = 0; r + 1 < rows; ++r) {
    const unsigned char *row = from + r * stride;
    std::int16_t *out = to + static_cast<std::ptrdiff_t>(r) * columns;
    for (int i = 0; i < columns; i += vector) {
      for (int k = 0; k < vector; ++k) {
        out[i + k] = static_cast<std::int16_t>(row[i + k] - 128);
      }
    }
  }
  const unsigned char *row = from + (rows - 1) * stride;
  for (int i = 0; i < columns; ++i) {
    to[static_cast<std::ptrdiff_t>(rows - 1) * columns + i] = static_cast<std::int16_t>(row[i] - 128);
  }
}

VISP_PATTERN_CLONES void addRow(const std::int16_t *q, float factor, int n, float *__restrict to)
{
  for (int i = 0; i < n; ++i) {
    to[i] += factor * static_cast<float>(q[i]);
  }
}

// True when the window is in the image.
bool fits(const vpImage<unsigned char> &image, const vpTemplateBank &bank, const vpTemplateBank::Place &place)
{
  return place.x >= bank.halfWidth() && place.y >= bank.halfHeight() &&
         place.x + bank.halfWidth() < static_cast<int>(image.getWidth()) &&
         place.y + bank.halfHeight() < static_cast<int>(image.getHeight());
}

// Contrast and step from z, with known slopes: three equations.
struct Step {
  double contrast, dx, dy;
};
Step solve(const vpTemplateBank::Phase &phase, const double *z, const vpSlopes &slopes)
{
  double u[4];
  for (std::size_t k = 1; k < 4; ++k) {
    // In brackets: terms known before z.
    u[k] = z[k] - ((phase.r[k][4] * slopes[0] + phase.r[k][5] * slopes[1]) +
                   (phase.r[k][6] * slopes[2] + phase.r[k][7] * slopes[3]));
  }
  const double uy = u[3] * phase.inverse[3], ux = (u[2] - phase.r[2][3] * uy) * phase.inverse[2];
  const double s = (u[1] - phase.r[1][2] * ux - phase.r[1][3] * uy) * phase.inverse[1], inverse = 1. / s;
  return {s, -ux * inverse, -uy * inverse};
}

// Contribution of the slopes to their own rows of the basis.
void knownSlopes(const vpTemplateBank::Phase &phase, const vpSlopes &slopes, double *z)
{
  for (std::size_t k = unknowns; k < size; ++k) {
    z[k] = 0.;
    for (std::size_t j = k; j < size; ++j) {
      z[k] += phase.r[k][j] * slopes[j - unknowns];
    }
  }
}

// Information of this cell alone about the slopes.
vpSlopes slopesOf(const vpTemplateBank::Phase &phase, const double *z)
{
  vpSlopes g{};
  for (std::size_t k = 4; k-- > 0;) {
    double v = z[k + 4];
    for (std::size_t j = k + 1; j < 4; ++j) {
      v -= phase.r[k + 4][j + 4] * g[j];
    }
    g[k] = v / phase.r[k + 4][k + 4];
  }
  return g;
}
} // namespace

vpCellAligner::vpCellAligner(std::size_t maxPixels)
  : m_room(alignedRoom<std::int16_t>(maxPixels + 32)), m_window(alignedBegin(m_room)), m_model(maxPixels + 32),
    m_mask(maxPixels + 32)
{}

void vpCellAligner::load(const vpImage<unsigned char> &image, const vpTemplateBank &bank,
                         const vpTemplateBank::Place &place)
{
  const int columns = 2 * bank.halfWidth() + 1, rows = 2 * bank.halfHeight() + 1;
  const unsigned char *from =
      image[static_cast<unsigned int>(place.y - bank.halfHeight())] + place.x - bank.halfWidth();
  toWindow(from, static_cast<std::ptrdiff_t>(image.getWidth()), columns, rows, m_window);
  std::fill(m_window + bank.pixels(), m_window + bank.stride(), static_cast<std::int16_t>(0));
}

void vpCellAligner::prefetch(const vpImage<unsigned char> &image, const vpTemplateBank &bank, double x, double y)
{
#if defined(__GNUC__)
  constexpr int most = 32, line = 64; // rows of a window, and bytes of a line of the cache
  const int left = static_cast<int>(x) - bank.halfWidth(), top = static_cast<int>(y) - bank.halfHeight();
  const int width = 2 * bank.halfWidth() + 1, height = 2 * bank.halfHeight() + 1;
  if (width > line || height > most || left < 0 || top < 0 || left + width > static_cast<int>(image.getWidth()) ||
      top + height > static_cast<int>(image.getHeight())) {
    return; // for big windows the processor prefetches by itself
  }
  const std::ptrdiff_t stride = image.getWidth();
  const unsigned char *from = image.bitmap + top * stride + left, *end = from + height * stride;
  for (; from != end; from += stride) {
    __builtin_prefetch(from);
    __builtin_prefetch(from + width - 1);
  }
#else
  static_cast<void>(image), static_cast<void>(bank), static_cast<void>(x), static_cast<void>(y);
#endif
}

vpCellFit vpCellAligner::align(const vpImage<unsigned char> &image, const vpTemplateBank &bank, double x, double y,
                               bool withSlopes)
{
  vpCellFit fit;
  int loadedX = -1, loadedY = -1;
  for (int step = 0; step < maxSteps; ++step) {
    const vpTemplateBank::Place place = bank.place(x, y);
    if (!fits(image, bank, place)) {
      return fit;
    }
    if (place.x != loadedX || place.y != loadedY) {
      load(image, bank, place);
      loadedX = place.x;
      loadedY = place.y;
    }
    const vpTemplateBank::Phase &phase = bank.phase(place.phase);
    double z[size];
    const double energy = projectStep(bank, phase, m_window, z);
    const Step s = solve(phase, z, m_slopes);
    // Without contrast no alignment is possible.
    if (!(s.contrast > 0.1 && s.contrast < 10.)) {
      return fit;
    }
    x = place.px + std::clamp(s.dx, -maxStep, maxStep);
    y = place.py + std::clamp(s.dy, -maxStep, maxStep);
    if (std::abs(s.dx) < bank.reach() && std::abs(s.dy) < bank.reach()) {
      if (withSlopes) {
        projectSlopes(phase, m_window, bank.stride(), z);
        fit.slopes = slopesOf(phase, z);
        fit.hasSlopes = true;
      }
      else {
        knownSlopes(phase, m_slopes, z); // accurate enough for the sum of the residuals
      }
      double rest = energy;
      for (const double v : z) {
        rest -= v * v;
      }
      fit.ok = true;
      fit.x = x;
      fit.y = y;
      fit.contrast = s.contrast;
      fit.variance =
          std::max(0.05, rest / std::max(1, bank.pixels() - size)); // rounding to whole grey values alone: 1/12
      const double unit = 1. / (s.contrast * s.contrast);
      fit.xx = phase.xx * unit;
      fit.yy = phase.yy * unit;
      return fit;
    }
  }
  return fit;
}

// Pixels that do not fit, and their neighbours: the rim of a speck is too faint to be detected and too dark to be
// correct.
void vpCellAligner::findMask(int n, int columns, float limit)
{
  std::fill_n(m_mask.begin(), n, static_cast<unsigned char>(0));
  for (int i = 0; i < n; ++i) {
    if (std::abs(m_model[static_cast<std::size_t>(i)] - static_cast<float>(m_window[static_cast<std::size_t>(i)])) <=
        limit) {
      continue;
    }
    for (int row = i - columns; row <= i + columns; row += columns) {
      for (int k = std::max(0, row - 1); k <= std::min(n - 1, row + 1); ++k) {
        m_mask[static_cast<std::size_t>(k)] = 1;
      }
    }
  }
}

vpCellFit vpCellAligner::alignMasked(const vpImage<unsigned char> &image, const vpTemplateBank &bank, double x,
                                     double y, double noise)
{
  // Q is orthonormal over all pixels. Without the masked ones its normal matrix is the unit matrix minus their
  // products, so that each round solves four equations exactly. The slopes h come from the other cells: dirt would tilt
  // them.
  constexpr int maxRounds = 8, lastRounds = 3;
  constexpr double limits[] = {6., 4.5, 3.5}; // wide at first: the dirt has biased the model towards itself
  using Vector4 = Eigen::Vector4d;
  vpCellFit fit;
  const int n = bank.pixels();
  int loadedX = -1, loadedY = -1, count = 0, settled = 0, opening = 0;
  vpTemplateBank::Place place{};
  double z[size] = {}, h[size] = {};
  Eigen::Matrix4d normal;
  Vector4 solution = Vector4::Zero();
  Step s{};
  std::array<double, 4> hidden{}; // hidden fractions of the left, right, upper and lower side
  bool started = false;
  for (int round = 0; round < maxRounds && settled < lastRounds; ++round) {
    const vpTemplateBank::Place next = bank.place(x, y);
    if (!fits(image, bank, next)) {
      return fit;
    }
    const vpTemplateBank::Phase &phase = bank.phase(next.phase);
    if (!started || next.phase != place.phase || next.x != place.x || next.y != place.y) {
      place = next;
      if (place.x != loadedX || place.y != loadedY) {
        load(image, bank, place);
        loadedX = place.x;
        loadedY = place.y;
      }
      static_cast<void>(projectStep(bank, phase, m_window, z));
      projectSlopes(phase, m_window, bank.stride(), z);
      for (std::size_t k = 0; k < size; ++k) {
        h[k] = phase.r[k][4] * m_slopes[0] + phase.r[k][5] * m_slopes[1] + phase.r[k][6] * m_slopes[2] +
               phase.r[k][7] * m_slopes[3];
      }
      for (int k = 0; k < 4; ++k) {
        solution[k] = z[k] - h[k];
      }
      started = true;
      settled = 0;
    }
    std::fill_n(m_model.begin(), n, 0.F);
    for (int k = 0; k < size; ++k) {
      const double value = h[k] + (k < 4 ? solution[k] : 0.);
      addRow(phase.q + k * bank.stride(), static_cast<float>(value) * phase.scale[static_cast<std::size_t>(k)], n,
             m_model.data());
    }
    const float limit = static_cast<float>(noise * limits[std::min(opening++, 2)]);
    normal.setIdentity();
    Vector4 right(z[0] - h[0], z[1] - h[1], z[2] - h[2], z[3] - h[3]);
    count = 0;
    findMask(n, 2 * bank.halfWidth() + 1, limit);
    hidden = {};
    for (int i = 0; i < n; ++i) {
      if (m_mask[static_cast<std::size_t>(i)] != 0) {
        const std::size_t k = static_cast<std::size_t>(i);
        ++count;
        double q[size];
        double value = m_window[k];
        for (int j = 0; j < size; ++j) {
          q[j] = static_cast<double>(phase.q[j * bank.stride() + i]) * phase.scale[static_cast<std::size_t>(j)];
          value -= q[j] * h[j];
        }
        const Vector4 a(q[0], q[1], q[2], q[3]);
        normal.noalias() -= a * a.transpose();
        right -= a * value;
        const int columns = 2 * bank.halfWidth() + 1;
        hidden[i % columns < bank.halfWidth() ? 0 : 1] += 2. * q[2] * q[2]; // the rows have length 1, half on each side
        hidden[i / columns < bank.halfHeight() ? 2 : 3] += 2. * q[3] * q[3];
      }
    }
    if (3 * count > n) {
      return fit;
    }
    solution = normal.ldlt().solve(right);
    for (std::size_t k = 0; k < size; ++k) {
      m_sum[k] = h[k] + (k < 4 ? solution[static_cast<Eigen::Index>(k)] : 0.);
    }
    s = solve(phase, m_sum.data(), m_slopes);
    if (!(s.contrast > 0.1 && s.contrast < 10.)) {
      return fit;
    }
    fit.x = place.px + std::clamp(s.dx, -maxStep, maxStep);
    fit.y = place.py + std::clamp(s.dy, -maxStep, maxStep);
    if (std::abs(s.dx) > bank.reach() || std::abs(s.dy) > bank.reach()) {
      x = fit.x; // a new phase restarts, but with the mask nearly closed
      y = fit.y;
    }
    settled += opening >= 3 ? 1 : 0;
  }
  double rest = 0.;
  for (int i = 0; i < n; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    rest += m_mask[k] != 0 ? 0. : std::pow(static_cast<double>(static_cast<float>(m_window[k]) - m_model[k]), 2);
  }
  const vpTemplateBank::Phase &phase = bank.phase(place.phase);
  Eigen::Matrix4d r = Eigen::Matrix4d::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      r(i, j) = phase.r[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  const Eigen::Matrix4d covariance = (r.transpose() * normal * r).inverse() / (s.contrast * s.contrast);
  fit.xx = covariance(2, 2);
  fit.yy = covariance(3, 3);
  fit.contrast = s.contrast;
  fit.variance = std::max(0.05, rest / std::max(1, n - count - size));
  fit.masked = true;
  // With both edges of an axis hidden the place is that of the start: a cell that was taken for another would stay there.
  const bool seen = std::min(hidden[0], hidden[1]) < mostHidden && std::min(hidden[2], hidden[3]) < mostHidden;
  fit.ok = settled > 0 && seen && fit.xx > 0. && fit.yy > 0. && std::abs(s.dx) < 2. * bank.reach() &&
           std::abs(s.dy) < 2. * bank.reach();
  fit.doubtX = !(std::max(hidden[0], hidden[1]) < mostHidden);
  fit.doubtY = !(std::max(hidden[2], hidden[3]) < mostHidden);
  return fit;
}

END_VISP_NAMESPACE
