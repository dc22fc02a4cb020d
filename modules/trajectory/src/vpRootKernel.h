/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRootKernel.h
 * \brief Root finding on raw coefficients, shared by vpPolynomial and the search for the smallest duration.
 */
#ifndef vpRootKernel_h
#define vpRootKernel_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace vpRootKernel
{
//! Value of the polynomial of this degree.
[[nodiscard]] inline double horner(const double *c, int degree, double s)
{
  double value = c[degree];
  for (int k = degree - 1; k >= 0; --k) {
    value = value * s + c[k];
  }
  return value;
}

//! Derivative coefficients; \e out has capacity for \e degree numbers.
inline void differentiate(const double *c, int degree, double *out)
{
  for (int k = 1; k <= degree; ++k) {
    out[k - 1] = k * c[k];
  }
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Rounding error of the value at s >= 0. Near zero the high coefficients do not matter: a bound over the whole interval
// would take small values there for zero and miss the root beside them.
inline double rounding(const double *c, int degree, double s)
{
  double sum = std::abs(c[degree]);
  for (int k = degree - 1; k >= 0; --k) {
    sum = sum * s + std::abs(c[k]);
  }
  return 2. * epsilon * sum;
}

// The root between l and r, where the polynomial is monotone and changes sign: Newton, bisection outside the bracket.
inline double closeIn(const double *c, int degree, double l, double r, double fl, double fr, double precision)
{
  double x = l + (r - l) * (fl / (fl - fr));
  for (int i = 0; i < 100; ++i) {
    double f = c[degree], slope = 0.;
    for (int k = degree - 1; k >= 0; --k) {
      slope = slope * x + f;
      f = f * x + c[k];
    }
    if (f == 0.) {
      return x;
    }
    ((f < 0.) == (fl < 0.) ? l : r) = x;
    double next = x - f / slope;
    if (!(next > l && next < r)) {
      next = 0.5 * (l + r);
    }
    if (std::abs(next - x) <= precision * x || next == l || next == r) {
      return next;
    }
    x = next;
  }
  return x;
}

//! Roots of a polynomial of degree <= 2 in [0, 1], ascending; returns their number.
inline int closedFormRoots(const double *c, int degree, double *out) noexcept
{
  int count = 0;
  const auto keep = [&](double s) {
    if (s >= 0. && s <= 1.) {
      out[count++] = s;
    }
  };
  if (degree == 2 && c[2] != 0.) {
    const double half = -0.5 * c[1];
    const double discriminant = half * half - c[0] * c[2];
    // A double root must not vanish because its discriminant is rounded to the wrong side of zero.
    if (discriminant < -4. * epsilon * half * half) {
      return 0;
    }
    const double root = std::sqrt(std::max(discriminant, 0.));
    const double sum = half + std::copysign(root, half);
    if (sum == 0.) { // c0 = c1 = 0
      keep(0.);
      return count;
    }
    keep(sum / c[2]);
    keep(c[0] / sum);
    if (count == 2) {
      if (out[0] > out[1]) {
        std::swap(out[0], out[1]);
      }
      count = out[0] == out[1] ? 1 : 2;
    }
  }
  else if (degree >= 1 && c[1] != 0.) {
    keep(-c[0] / c[1]);
  }
  return count;
}

//! What rootsBetween() computes.
enum class Wanted {
  Roots,  //!< All roots to the last digit, also where the polynomial touches zero.
  Extrema //!< Roots for extrema of the next lower derivative: sign changes only, to 1e-9, whose square matters.
};

/*!
 * Roots in [0, 1] of a polynomial whose derivative has the roots \e critical there; returns their number.
 */
inline int rootsBetween(const double *c, int degree, const double *critical, int criticalCount, Wanted wanted,
                        double *out) noexcept
{
  const bool touching = wanted == Wanted::Roots;
  // At an extremum an error of s enters squared: 1e-7 causes 1e-13 of the value.
  const double precision = touching ? 2. * epsilon : 1e-7;
  int count = 0;
  double l = 0., fl = c[0];
  if (touching && fl == 0.) {
    out[count++] = 0.;
  }
  for (int i = 0; i <= criticalCount && count < degree; ++i) {
    const double r = i < criticalCount ? critical[i] : 1.;
    if (r <= l) {
      continue;
    }
    double fr = horner(c, degree, r);
    if (touching && std::abs(fr) <= rounding(c, degree, r)) {
      fr = 0.;
    }
    if (fl * fr < 0.) {
      out[count++] = closeIn(c, degree, l, r, fl, fr, precision);
    }
    else if (fr == 0. && touching) {
      out[count++] = r;
    }
    l = r;
    fl = fr;
  }
  return count;
}

// 1/binomial(n, k)
constexpr double inverseBinomial[9][9] = {{1.},
                                          {1., 1.},
                                          {1., 1. / 2., 1.},
                                          {1., 1. / 3., 1. / 3., 1.},
                                          {1., 1. / 4., 1. / 6., 1. / 4., 1.},
                                          {1., 1. / 5., 1. / 10., 1. / 10., 1. / 5., 1.},
                                          {1., 1. / 6., 1. / 15., 1. / 20., 1. / 15., 1. / 6., 1.},
                                          {1., 1. / 7., 1. / 21., 1. / 35., 1. / 35., 1. / 21., 1. / 7., 1.},
                                          {1., 1. / 8., 1. / 28., 1. / 56., 1. / 70., 1. / 56., 1. / 28., 1. / 8., 1.}};

//! The extremes of the Bernstein coefficients.
template <int N> inline void enclose(const double *c, double &low, double &high) noexcept
{
  double b[N + 1];
  for (int k = 0; k <= N; ++k) {
    b[k] = c[k] * inverseBinomial[N][k];
  }
  for (int pass = 1; pass <= N; ++pass) {
    for (int k = N; k >= pass; --k) {
      b[k] += b[k - 1];
    }
  }
  low = high = b[0];
  for (int k = 1; k <= N; ++k) {
    low = std::min(low, b[k]);
    high = std::max(high, b[k]);
  }
}

//! Bounds of the polynomial on [0, 1]: the extremes of its Bernstein coefficients, which enclose it. Degree <= 8.
inline void enclose(const double *c, int degree, double &low, double &high) noexcept
{
  switch (degree) { // unrolled
  case 0:
    low = high = c[0];
    break;
  case 1:
    return enclose<1>(c, low, high);
  case 2:
    return enclose<2>(c, low, high);
  case 3:
    return enclose<3>(c, low, high);
  case 4:
    return enclose<4>(c, low, high);
  case 5:
    return enclose<5>(c, low, high);
  case 6:
    return enclose<6>(c, low, high);
  case 7:
    return enclose<7>(c, low, high);
  default:
    return enclose<8>(c, low, high);
  }
}

//! Whether the polynomial stays between these values on [0, 1]: by enclose() or a value that decides, else by the roots of
//! its derivative. Degree <= 8.
bool staysWithin(const double *c, int degree, double low, double high) noexcept;

//! Smallest and largest value on [from, 1], within [0, 1]; its places to 1e-7, so the values to 1e-13. Degree <= 8.
void extremes(const double *c, int degree, double from, double &low, double &high) noexcept;

//! True when |polynomial| <= bound on [0, 1] is certain from enclose(). False says nothing.
inline bool isSurelyWithin(const double *c, int degree, double bound) noexcept
{
  double low = 0., high = 0.;
  enclose(c, degree, low, high);
  return low >= -bound && high <= bound;
}

//! All roots in [0, 1], touching ones included unless Extrema are wanted; \e out has room for \e degree numbers.
int allRoots(const double *c, int degree, double *out, Wanted wanted = Wanted::Roots) noexcept;

/*!
 * Smallest x > 0 with g(x) = 0, where g(0) = c[0] > 0; infinity if there is none. Closed form up to degree 2.
 */
double firstPositiveRoot(const double *c, int degree) noexcept;
} // namespace vpRootKernel

END_VISP_NAMESPACE
#endif
