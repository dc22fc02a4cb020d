/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/servoing/vpServoTiming.h>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double shortest = 1e-7; // s, upper bound of the first bin divided by one bin's factor
constexpr double perDecade = 50.;

// One writer: no read-modify-write is needed.
void increase(std::atomic<std::uint64_t> &counter) noexcept
{
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}
} // namespace

double vpTimingStatistics::upperBound(std::size_t bin) noexcept
{
  return shortest * std::pow(10., static_cast<double>(bin + 1) / perDecade);
}

void vpTimingStatistics::add(double seconds) noexcept
{
  if (!(seconds >= 0.)) {
    increase(m_invalid);
    return;
  }
  const double position = std::floor(perDecade * std::log10(std::max(seconds, shortest) / shortest));
  increase(m_bins[static_cast<std::size_t>(std::min(position, bins - 1.))]);
  m_max.store(std::max(seconds, max()), std::memory_order_relaxed);
  increase(m_count);
}

double vpTimingStatistics::quantile(double share) const noexcept
{
  const double needed = share * static_cast<double>(count());
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    seen += countOf(bin);
    if (seen > 0 && static_cast<double>(seen) >= needed) {
      return std::min(upperBound(bin), max());
    }
  }
  return seen > 0 ? max() : std::numeric_limits<double>::quiet_NaN();
}

END_VISP_NAMESPACE
