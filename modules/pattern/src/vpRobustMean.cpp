/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpRobustMean.h"

#include "vpPatternSimd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int few = 32;

#if defined(__GNUC__)
// The greatest value that has at most n / 2 others below it. All against all, four at a time: without value-dependent
// branches, and easy to vectorise. Three times as fast as sorting.
VISP_PATTERN_CLONES double medianOfFew(const double *values, int n)
{
  using Four = double __attribute__((vector_size(32)));
  using Counts = std::int64_t __attribute__((vector_size(32)));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int blocks = (n + 3) / 4;
  const std::int64_t half = -(n / 2); // a true comparison is -1
  Four padded[few / 4], best = {-infinity, -infinity, -infinity, -infinity};
  padded[blocks - 1] = -best;
  std::memcpy(padded, values, static_cast<std::size_t>(n) * sizeof(double));
  for (int block = 0; block < blocks; ++block) {
    const Four mine = padded[block];
    Counts below = {0, 0, 0, 0};
    for (int k = 0; k < n; ++k) {
      const double v = values[k];
      below += Four{v, v, v, v} < mine;
    }
    const Four candidate = below >= Counts{half, half, half, half} ? mine : best;
    best = candidate > best ? candidate : best;
  }
  return std::max(std::max(best[0], best[1]), std::max(best[2], best[3]));
}
#else
double medianOfFew(const double *values, int n)
{
  std::array<double, few> sorted;
  std::copy_n(values, n, sorted.begin());
  std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.begin() + n);
  return sorted[static_cast<std::size_t>(n / 2)];
}
#endif

/*
 * The value of the given rank; reorders the values. std::nth_element mispredicts every second of its comparisons; here a
 * pass has no branch that depends on the values, and the pivot, from a sample, lies just beyond the rank, so that two
 * passes leave a quarter.
 */
double valueOfRank(double *values, std::size_t n, std::size_t rank)
{
  constexpr std::size_t samples = 64, beyond = 5; // the median of 64 deviates by 4 ranks
  constexpr int mostPasses = 12;
  for (int pass = 0; pass < mostPasses && n > 2 * samples; ++pass) {
    std::array<double, samples> sample;
    for (std::size_t k = 0; k < samples; ++k) {
      sample[k] = values[k * n / samples];
    }
    const std::size_t place = rank * samples / n;
    const bool above = 2 * rank < n;
    const std::size_t at = above ? std::min(place + beyond, samples - 1) : place - std::min(place, beyond);
    std::nth_element(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(at), sample.end());
    const double pivot = sample[at];
    std::size_t below = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double v = values[i];
      values[i] = values[below];
      values[below] = v;
      below += v < pivot ? 1 : 0;
    }
    if (rank < below) {
      n = below;
    }
    else {
      values += below;
      n -= below;
      rank -= below;
    }
  }
  std::nth_element(values, values + rank, values + n);
  return values[rank];
}

// Tukey's weight of each value over its variance: 0 beyond five deviations.
VISP_PATTERN_CLONES void weigh(const double *values, const double *variances, double centre, double spread, int n,
                               double *__restrict weights)
{
  for (int i = 0; i < n; ++i) {
    const double d = values[i] - centre, v = variances[i], s2 = 25. * (v > spread * spread ? v : spread * spread);
    const double rest = 1. - d * d / s2;
    weights[i] = rest > 0. ? rest * rest / v : 0.;
  }
}
} // namespace

vpRobustMean::vpRobustMean(std::size_t capacity)
{
  m_values.reserve(capacity);
  m_variances.reserve(capacity);
  m_scratch.reserve(capacity);
}

void vpRobustMean::choose(const std::vector<double> &values, const std::vector<unsigned char> &use, unsigned char least,
                          std::vector<double> &chosen)
{
  const std::size_t n = use.size();
  chosen.resize(n);
  std::size_t k = 0;
  for (std::size_t i = 0; i < n; ++i) {
    chosen[k] = values[i];
    k += use[i] >= least ? 1 : 0;
  }
  chosen.resize(k);
}

void vpRobustMean::assign(const std::vector<double> &values, const std::vector<double> &variances,
                          const std::vector<unsigned char> &use, unsigned char least)
{
  choose(values, use, least, m_values);
  choose(variances, use, least, m_variances);
}

double vpRobustMean::median(std::vector<double> &values)
{
  if (values.empty()) {
    return 0.;
  }
  if (values.size() <= few) {
    return medianOfFew(values.data(), static_cast<int>(values.size()));
  }
  return valueOfRank(values.data(), values.size(), values.size() / 2);
}

vpRobustMean::Result vpRobustMean::mean()
{
  m_scratch.assign(m_values.begin(), m_values.end());
  return mean(median(m_scratch));
}

vpRobustMean::Result vpRobustMean::mean(double centre)
{
  Result result;
  if (m_values.empty()) {
    return result;
  }
  m_scratch.resize(m_values.size());
  for (std::size_t i = 0; i < m_values.size(); ++i) {
    m_scratch[i] = std::abs(m_values[i] - centre);
  }
  const double spread = 1.48 * median(m_scratch);
  weigh(m_values.data(), m_variances.data(), centre, spread, static_cast<int>(m_values.size()), m_scratch.data());
  double sum = 0., weights = 0., squares = 0.;
  for (std::size_t i = 0; i < m_values.size(); ++i) {
    const double w = m_scratch[i];
    sum += w * m_values[i];
    weights += w;
    squares += w * w * m_variances[i];
    result.count += w > 0. ? 1 : 0;
  }
  if (result.count > 0) {
    result.value = sum / weights;
    result.variance = squares / (weights * weights);
  }
  return result;
}

END_VISP_NAMESPACE
