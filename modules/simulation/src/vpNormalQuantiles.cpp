/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpNormalQuantiles.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

vpNormalQuantiles::vpNormalQuantiles() : m_table(65536)
{
  // Newton's method from the quantile before, outwards from the middle; the lower half mirrors the upper.
  constexpr std::size_t half = 32768;
  double z = 0.;
  double sum = 0.;
  std::vector<double> upper(half);
  for (std::size_t k = 0; k < half; ++k) {
    const double tail = 0.5 - (static_cast<double>(k) + 0.5) / (2. * half);
    for (int i = 0; i < 8; ++i) {
      z += (0.5 * std::erfc(z * M_SQRT1_2) - tail) * std::sqrt(2. * M_PI) * std::exp(0.5 * z * z);
    }
    upper[k] = z;
    sum += z * z;
  }
  const double toUnit = std::sqrt(half / sum); // what the cut tails took
  for (std::size_t k = 0; k < half; ++k) {
    m_table[half + k] = static_cast<float>(toUnit * upper[k]);
    m_table[half - 1 - k] = -m_table[half + k];
  }
}

const vpNormalQuantiles &vpNormalQuantiles::get()
{
  static const vpNormalQuantiles table;
  return table;
}

END_VISP_NAMESPACE
