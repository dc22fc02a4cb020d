/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpHashRandom.h
 * \brief Random numbers determined by a key, such as the row and column of a cell, independent of the drawing order.
 */
#ifndef vpHashRandom_h
#define vpHashRandom_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <cmath>
#include <cstdint>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Stream of random numbers for (seed, purpose, a, b): splitmix64 seeded by a hash of the four.
 */
class vpHashRandom
{
public:
  //! Purpose of the numbers; streams of different purposes are independent.
  enum class Purpose : std::uint64_t { Cell = 1, Flex, Dust, Crack, Noise, Scene, CameraPose, Planner };

  vpHashRandom(unsigned int seed, Purpose purpose, std::int64_t a, std::int64_t b)
    : m_state(mix(mix(mix(static_cast<std::uint64_t>(purpose) << 32 | seed) ^ static_cast<std::uint64_t>(a)) ^
                  static_cast<std::uint64_t>(b)))
  {}
  //! 64 random bits.
  std::uint64_t bits()
  {
    m_state += GOLDEN;
    return mix(m_state);
  }
  //! Uniform in [low, high).
  double uniform(double low = 0., double high = 1.)
  {
    return low + (high - low) * 0x1p-53 * static_cast<double>(bits() >> 11);
  }

private:
  static constexpr std::uint64_t GOLDEN = 0x9e3779b97f4a7c15U;
  static std::uint64_t mix(std::uint64_t z)
  {
    z += GOLDEN; // otherwise zero would stay zero
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::uint64_t m_state;
};

/*!
 * \brief Quantiles of the standard normal distribution at (k + 1/2) / 65536: up to +-4.3; the variance of a
 * random entry is 1 within 1e-6.
 */
class vpNormalQuantiles
{
public:
  //! The table, created at its first use.
  static const vpNormalQuantiles &get();
  float operator[](std::uint16_t k) const { return m_table[k]; }

private:
  vpNormalQuantiles();
  std::vector<float> m_table;
};

inline vpNormalQuantiles::vpNormalQuantiles() : m_table(65536)
{
  // Newton's method from the previous quantile, outwards from the middle; the lower half mirrors the upper.
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
  const double toUnit = std::sqrt(half / sum); // compensates the truncated tails
  for (std::size_t k = 0; k < half; ++k) {
    m_table[half + k] = static_cast<float>(toUnit * upper[k]);
    m_table[half - 1 - k] = -m_table[half + k];
  }
}

inline const vpNormalQuantiles &vpNormalQuantiles::get()
{
  static const vpNormalQuantiles table;
  return table;
}

END_VISP_NAMESPACE
#endif
