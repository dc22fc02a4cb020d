/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "spread.h"

#include <visp3/direct_core/vpQuantile.h>

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

double Spread::quantile(double share) const { return m_values.empty() ? 0. : vpQuantile(m_values, share); }
} // namespace thesisReport
