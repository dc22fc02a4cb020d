/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpProductLattice.h"

#include "vpHashRandom.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

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
