/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "spread.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace thesisReport
{
double Spread::mean() const
{
  return m_values.empty() ? 0. : std::accumulate(m_values.begin(), m_values.end(), 0.) / static_cast<double>(count());
}

double Spread::sigma() const
{
  const double centre = mean();
  double sum = 0.;
  for (const double value : m_values) {
    sum += (value - centre) * (value - centre);
  }
  return count() < 2 ? 0. : std::sqrt(sum / static_cast<double>(count() - 1));
}

double Spread::rms() const
{
  double sum = 0.;
  for (const double value : m_values) {
    sum += value * value;
  }
  return m_values.empty() ? 0. : std::sqrt(sum / static_cast<double>(count()));
}

double Spread::largest() const { return quantile(1.); }

double Spread::quantile(double share) const
{
  if (m_values.empty()) {
    return 0.;
  }
  std::vector<double> sorted = m_values;
  const auto wanted = sorted.begin() + static_cast<std::ptrdiff_t>(
                                           std::ceil(std::clamp(share, 0., 1.) * static_cast<double>(count() - 1)));
  std::nth_element(sorted.begin(), wanted, sorted.end());
  return *wanted;
}
} // namespace thesisReport
