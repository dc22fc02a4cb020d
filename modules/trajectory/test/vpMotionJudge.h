/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionJudge.h
 * \brief Extremes of a motion, computed from its printed pieces by definition, independently of the module.
 */
#ifndef vpMotionJudge_h
#define vpMotionJudge_h

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace vpTrajectoryTest
{
//! Value of the derivative \e d of c[0] + c[1] t + ..., term by term.
inline double derivativeAt(const std::vector<double> &c, int d, double t)
{
  long double sum = 0.L, power = 1.L;
  for (std::size_t k = static_cast<std::size_t>(d); k < c.size(); ++k, power *= t) {
    long double factor = c[k];
    for (int i = 0; i < d; ++i) {
      factor *= static_cast<long double>(k) - i;
    }
    sum += factor * power;
  }
  return static_cast<double>(sum);
}

//! Sign changes of the derivative \e d in [0, T], by bisection between the sign changes of the next one.
inline std::vector<double> signChanges(const std::vector<double> &c, int d, double T)
{
  std::vector<double> out;
  if (d + 1 >= static_cast<int>(c.size())) {
    return out;
  }
  std::vector<double> between = signChanges(c, d + 1, T);
  between.push_back(T);
  double from = 0.;
  for (double to : between) {
    const bool rising = derivativeAt(c, d, from) < 0.;
    if (rising != (derivativeAt(c, d, to) < 0.)) {
      double low = from, high = to;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((derivativeAt(c, d, middle) < 0.) == rising ? low : high) = middle;
      }
      out.push_back(0.5 * (low + high));
    }
    from = to;
  }
  return out;
}

//! \brief Extremes of one axis over a motion.
struct Extremes {
  double low = std::numeric_limits<double>::infinity();   //!< Lowest position.
  double high = -std::numeric_limits<double>::infinity(); //!< Highest position.
  std::array<double, 3> peak{};                           //!< Largest |v|, |a|, |j|.
  bool finite = true;                                     //!< All coefficients are finite.

  //! Add a piece of duration T: its ends, its exact extrema, and some times in between.
  void include(const std::vector<double> &c, double T)
  {
    for (double x : c) {
      finite = finite && std::isfinite(x);
    }
    for (int d = 0; d <= 3 && finite; ++d) {
      std::vector<double> times = signChanges(c, d + 1, T);
      for (int i = 0; i <= 4; ++i) {
        times.push_back(T * i / 4.);
      }
      for (double t : times) {
        const double x = derivativeAt(c, d, t);
        if (d == 0) {
          low = std::min(low, x);
          high = std::max(high, x);
        }
        else {
          double &most = peak[static_cast<std::size_t>(d) - 1];
          most = std::max(most, std::abs(x));
        }
      }
    }
  }
};
} // namespace vpTrajectoryTest

#endif
