/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpHashRandom.h
 * \brief Random numbers that hang on a name, such as the row and column of a cell, and on nothing before.
 */
#ifndef vpHashRandom_h
#define vpHashRandom_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <cstdint>

BEGIN_VISP_NAMESPACE

/*!
 * \brief A stream of random numbers for (seed, purpose, a, b): splitmix64 from a hash of the four.
 */
class vpHashRandom
{
public:
  //! What the numbers are for; streams of different purposes are independent.
  enum class Purpose : std::uint64_t { Cell = 1, Flex, Dust, Crack, Noise, Scene, CameraPose };

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
    z += GOLDEN; // or zero would stay zero
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::uint64_t m_state;
};

END_VISP_NAMESPACE
#endif
