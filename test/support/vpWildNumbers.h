/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpWildNumbers.h
 * \brief Invalid numbers that no sensor should send and that no control step may fail on.
 *
 * NaN, infinities, magnitudes whose squares, cubes or sums overflow, denormals, signed zeros; time steps and time
 * stamps that repeat, jump and run backwards. A test feeds them to a step, one at a time (everyPlace()) and mixed into
 * ordinary input (mixed()), and accepts only finite output within the limits and a status. Use atMost() for
 * comparisons: it is false for NaN.
 */
#ifndef vpWildNumbers_h
#define vpWildNumbers_h

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

namespace vpWildNumbers
{
//! The numbers; the first three are not finite.
inline constexpr std::array<double, 26> values{
    {std::numeric_limits<double>::quiet_NaN(),
     std::numeric_limits<double>::infinity(),
     -std::numeric_limits<double>::infinity(),
     std::numeric_limits<double>::max(),
     -std::numeric_limits<double>::max(),
     1e300,
     -1e300,
     1e200,
     -1e200,
     1e155, // squares overflow from here on: sqrt(max) = 1.34e154
     -1e155,
     1e154,
     -1e154, // sums of squares overflow
     1e103,
     -1e103, // cubes
     1e12,
     -1e12,
     1e9, // beyond the range of 32 bits
     -1e9,
     1e-155,
     std::numeric_limits<double>::min(),        // the smallest normal number: its inverse is finite
     std::numeric_limits<double>::denorm_min(), // its inverse is not
     -std::numeric_limits<double>::denorm_min(),
     std::numeric_limits<double>::epsilon(),
     0.,
     -0.}};

//! One of #values.
inline double any(std::mt19937_64 &rng)
{
  return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(rng)];
}

//! \e ordinary, or with the probability \e share one of #values.
inline double mixed(std::mt19937_64 &rng, double ordinary, double share)
{
  return std::uniform_real_distribution<double>(0., 1.)(rng) < share ? any(rng) : ordinary;
}

//! Applies mixed() to each number of a container (std::array, std::vector, Eigen vector of doubles) in place.
template <class Numbers> void mix(std::mt19937_64 &rng, Numbers &numbers, double share)
{
  for (decltype(numbers.size()) i = 0; i < numbers.size(); ++i) {
    numbers[i] = mixed(rng, numbers[i], share);
  }
}

/*!
 * Calls \e step(numbers) for each position of \e ordinary and each of #values put there, all others unchanged: each
 * field is reached, which random input does not guarantee. The two indices identify a failure.
 * \param step : void(const Numbers &numbers, std::size_t place, std::size_t value).
 */
template <class Numbers, class Step> void everyPlace(const Numbers &ordinary, Step &&step)
{
  for (std::size_t place = 0; place < static_cast<std::size_t>(ordinary.size()); ++place) {
    for (std::size_t value = 0; value < values.size(); ++value) {
      Numbers numbers = ordinary;
      numbers[static_cast<decltype(numbers.size())>(place)] = values[value];
      step(numbers, place, value);
    }
  }
}

/*!
 * Time stamps of a clock that advances by \e period most of the time, and else stands still, skips, runs backwards, or
 * is momentarily one of #values. Invalid stamps do not affect later ones.
 */
class Clock
{
public:
  explicit Clock(double period, double start = 0.) : m_period(period), m_time(start) {}

  //! The next time stamp, s; irregular with the probability \e share.
  double next(std::mt19937_64 &rng, double share)
  {
    if (std::uniform_real_distribution<double>(0., 1.)(rng) >= share) {
      return m_time += m_period;
    }
    switch (std::uniform_int_distribution<int>(0, 5)(rng)) {
    case 0:
      return m_time; // the same again
    case 1:
      return m_time += 1e4 * m_period; // a long pause
    case 2:
      return m_time -= 10. * m_period; // set back
    case 3:
      return m_time - m_period; // out of order, once
    case 4:
      return m_time = std::nextafter(m_time, std::numeric_limits<double>::infinity()); // no time at all
    default:
      return any(rng);
    }
  }

private:
  double m_period;
  double m_time;
};

//! True if no number of a container is infinite or NaN.
template <class Numbers> bool allFinite(const Numbers &numbers)
{
  for (decltype(numbers.size()) i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i])) {
      return false;
    }
  }
  return true;
}

//! |x| <= limit with a relative \e slack for rounding; false if either is NaN.
inline bool atMost(double x, double limit, double slack = 1e-9) { return std::abs(x) <= limit * (1. + slack); }
} // namespace vpWildNumbers

#endif
