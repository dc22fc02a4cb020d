/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpRestTest.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Hysteresis: factor on the thresholds for leaving rest, so that noise does not cause motion.
constexpr double slopeHysteresis = 1.5, scatterHysteresis = 2.;
} // namespace

// Weighted least-squares line through the newest measurements.
vpRestTest::Line vpRestTest::fit(int count) const
{
  Line line;
  for (int k = 0; k < count; ++k) {
    const Sample &s = newest(k);
    line.weight += s.weight;
    line.time += s.weight * (s.time - newest(0).time); // differences: times may be large numbers
    line.mean += s.weight * (s.value - newest(0).value);
  }
  line.time = newest(0).time + line.time / line.weight;
  line.mean = newest(0).value + line.mean / line.weight;
  for (int k = 0; k < count; ++k) {
    const Sample &s = newest(k);
    const double t = s.time - line.time;
    line.spread += s.weight * t * t;
    line.slope += s.weight * t * (s.value - line.mean);
    line.scatter += s.weight * (s.value - line.mean).squaredNorm();
  }
  line.slope /= line.spread;
  return line;
}

bool vpRestTest::isConstant(const Line &line, int count, double slopeSigmas, double scatterSigmas)
{
  const double freedom = 3. * (count - 1);
  return line.slope.squaredNorm() * line.spread <= slopeSigmas * slopeSigmas &&
         line.scatter <= freedom + scatterSigmas * std::sqrt(2. * freedom);
}

// Smallest number of newest measurements with sufficient accuracy of the slope; 0 if all are too few.
int vpRestTest::enough(const Limits &limits) const
{
  for (int count = 3; count <= m_count; ++count) {
    if (limits.sigmas <= limits.speed * std::sqrt(fit(count).spread)) {
      return count;
    }
  }
  return 0;
}

void vpRestTest::add(double time, const Eigen::Vector3d &value, double variance, const Limits &limits)
{
  m_samples[static_cast<std::size_t>(m_next)] = {time, value, 1. / variance};
  m_next = (m_next + 1) % capacity;
  m_count = std::min(m_count + 1, capacity);
  const int count = enough(limits);
  if (count == 0 || !(limits.sigmas > 0.)) {
    m_resting = 0;
    return;
  }
  const Line line = fit(count);
  if (m_resting > 0) {
    // The few newest detect a start quickly, all together detect slow creep.
    m_resting = std::max(std::min(m_resting + 1, capacity), count);
    m_line = fit(m_resting);
    const double slope = slopeHysteresis * limits.sigmas, scatter = scatterHysteresis * limits.sigmas;
    if (isConstant(line, count, slope, scatter) && isConstant(m_line, m_resting, slope, scatter)) {
      return;
    }
    m_resting = 0;
  }
  else if (isConstant(line, count, limits.sigmas, limits.sigmas)) {
    m_resting = count;
    m_line = line;
  }
}

double vpRestTest::variance(double time) const
{
  const double t = time - m_line.time;
  return 1. / m_line.weight + t * t / m_line.spread;
}

END_VISP_NAMESPACE
