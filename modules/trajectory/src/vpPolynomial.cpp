/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpPolynomial.h>

#include "vpRootKernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace vpRootKernel
{
namespace
{
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

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

// Rounding error of the value at s >= 0. Near zero the high coefficients do not matter: a bound over the whole interval
// would take small values there for zero and miss the root beside them.
double rounding(const double *c, int degree, double s)
{
  double sum = std::abs(c[degree]);
  for (int k = degree - 1; k >= 0; --k) {
    sum = sum * s + std::abs(c[k]);
  }
  return 2. * epsilon * sum;
}

// The root between l and r, where the polynomial is monotone and changes sign: Newton, bisection outside the bracket.
double closeIn(const double *c, int degree, double l, double r, double fl, double fr, double precision)
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
} // namespace

int closedFormRoots(const double *c, int degree, double *out) noexcept
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

int rootsBetween(const double *c, int degree, const double *critical, int criticalCount, Wanted wanted,
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

namespace
{
template <int N> void bernstein(const double *c, double *b)
{
  for (int k = 0; k <= N; ++k) {
    b[k] = c[k] * inverseBinomial[N][k];
  }
  for (int pass = 1; pass <= N; ++pass) {
    for (int k = N; k >= pass; --k) {
      b[k] += b[k - 1];
    }
  }
}

void bernstein(const double *c, int degree, double *b)
{
  switch (degree) { // unrolled
  case 0:
    b[0] = c[0];
    break;
  case 1:
    return bernstein<1>(c, b);
  case 2:
    return bernstein<2>(c, b);
  case 3:
    return bernstein<3>(c, b);
  case 4:
    return bernstein<4>(c, b);
  case 5:
    return bernstein<5>(c, b);
  case 6:
    return bernstein<6>(c, b);
  case 7:
    return bernstein<7>(c, b);
  default:
    return bernstein<8>(c, b);
  }
}

enum class Decision { Within, Beyond, Open };

// By halves, from the Bernstein coefficients; those at the ends are values, which rounding does not change by slack.
Decision decide(double *b, int degree, double low, double high, double slack, int depth)
{
  bool within = true;
  for (int k = 0; k <= degree; ++k) {
    within = within && b[k] >= low && b[k] <= high;
  }
  if (within) {
    return Decision::Within;
  }
  if (b[0] < low - slack || b[0] > high + slack || b[degree] < low - slack || b[degree] > high + slack) {
    return Decision::Beyond;
  }
  if (depth == 0) {
    return Decision::Open;
  }
  double left[9];
  for (int k = 0; k <= degree; ++k) { // de Casteljau; b becomes the right half
    left[k] = b[0];
    for (int i = 0; i < degree - k; ++i) {
      b[i] = 0.5 * (b[i] + b[i + 1]);
    }
  }
  const Decision first = decide(left, degree, low, high, slack, depth - 1);
  if (first == Decision::Beyond) {
    return first;
  }
  const Decision second = decide(b, degree, low, high, slack, depth - 1);
  return second == Decision::Within ? first : second;
}
} // namespace

void enclose(const double *c, int degree, double &low, double &high) noexcept
{
  double b[9];
  bernstein(c, degree, b);
  low = high = b[0];
  for (int k = 1; k <= degree; ++k) {
    low = std::min(low, b[k]);
    high = std::max(high, b[k]);
  }
}

bool staysWithin(const double *c, int degree, double low, double high) noexcept
{
  constexpr int depth = 3;
  double b[9], sum = 0.;
  bernstein(c, degree, b);
  for (int k = 0; k <= degree; ++k) {
    sum += std::abs(c[k]);
  }
  const Decision decision = decide(b, degree, low, high, 32. * epsilon * sum, depth);
  if (decision == Decision::Open) {
    double min = 0., max = 0.;
    extremes(c, degree, 0., min, max);
    return min >= low && max <= high;
  }
  return decision == Decision::Within;
}

void extremes(const double *c, int degree, double from, double &low, double &high) noexcept
{
  const double first = horner(c, degree, from), last = horner(c, degree, 1.);
  low = std::min(first, last);
  high = std::max(first, last);
  double slope[9], places[9];
  slope[0] = 0.;
  differentiate(c, degree, slope);
  const int count = allRoots(slope, std::max(degree - 1, 0), places, Wanted::Extrema);
  for (int i = 0; i < count; ++i) {
    const double value = horner(c, degree, std::max(places[i], from));
    low = std::min(low, value);
    high = std::max(high, value);
  }
}

bool isSurelyWithin(const double *c, int degree, double bound) noexcept
{
  double low = 0., high = 0.;
  enclose(c, degree, low, high);
  return low >= -bound && high <= bound;
}

int allRoots(const double *c, int degree, double *out, Wanted wanted) noexcept
{
  while (degree > 0 && c[degree] == 0.) {
    --degree;
  }
  if (degree <= 2) {
    return closedFormRoots(c, degree, out);
  }
  // Derivatives down to the quadratic, then back up: the roots of each split the next into monotone pieces.
  double chain[vpPolynomial::maxDegree][vpPolynomial::maxDegree + 1];
  int depth = 0;
  const double *upper = c;
  for (int d = degree; d > 2; --d) {
    differentiate(upper, d, chain[depth]);
    upper = chain[depth++];
  }
  double critical[vpPolynomial::maxDegree];
  int count = closedFormRoots(upper, 2, critical);
  for (int d = 3; d <= degree; ++d) {
    const double *level = d == degree ? c : chain[degree - d - 1];
    double found[vpPolynomial::maxDegree];
    count = rootsBetween(level, d, critical, count, wanted, found);
    std::copy(found, found + count, critical);
  }
  std::copy(critical, critical + count, out);
  return count;
}

double firstPositiveRoot(const double *c, int degree) noexcept
{
  while (degree > 0 && c[degree] == 0.) {
    --degree;
  }
  if (degree == 0) {
    return infinity;
  }
  if (degree == 1) {
    return c[1] < 0. ? -c[0] / c[1] : infinity;
  }
  if (degree == 2) {
    const double discriminant = c[1] * c[1] - 4. * c[2] * c[0];
    if (discriminant < 0. || (c[2] > 0. && c[1] >= 0.)) {
      return infinity;
    }
    const double root = std::sqrt(discriminant);
    return c[1] <= 0. ? 2. * c[0] / (root - c[1]) : (c[1] + root) / (-2. * c[2]);
  }
  // Fujiwara's bound on all roots, then the roots on [0, bound] mapped to [0, 1].
  double bound = 0.;
  for (int k = 1; k <= degree; ++k) {
    bound = std::max(bound, 2. * std::pow(std::abs(c[degree - k] / c[degree]), 1. / k));
  }
  if (!std::isfinite(bound)) {
    return firstPositiveRoot(c, degree - 1); // the leading coefficient is negligible
  }
  double scaled[vpPolynomial::maxDegree + 1];
  double power = 1.;
  for (int k = 0; k <= degree; ++k, power *= bound) {
    scaled[k] = c[k] * power;
  }
  double roots[vpPolynomial::maxDegree];
  const int count = allRoots(scaled, degree, roots);
  for (int i = 0; i < count; ++i) {
    if (roots[i] > 0.) {
      return roots[i] * bound;
    }
  }
  return infinity;
}
} // namespace vpRootKernel

vpPolynomial::vpPolynomial(std::initializer_list<double> coefficients)
{
  const int count = std::min(static_cast<int>(coefficients.size()), maxDegree + 1);
  std::copy_n(coefficients.begin(), count, m_c.begin());
  m_degree = std::max(count - 1, 0);
}

void vpPolynomial::setDegree(int degree)
{
  degree = std::clamp(degree, 0, maxDegree);
  for (int k = m_degree + 1; k <= degree; ++k) {
    (*this)[k] = 0.;
  }
  m_degree = degree;
}

double vpPolynomial::value(double s) const noexcept { return vpRootKernel::horner(m_c.data(), m_degree, s); }

std::array<double, 4> vpPolynomial::jet(double s) const noexcept
{
  // Repeated Horner: each row divides the one before by (x - s).
  double p = 0., d1 = 0., d2 = 0., d3 = 0.;
  for (int k = m_degree; k >= 0; --k) {
    d3 = d3 * s + d2;
    d2 = d2 * s + d1;
    d1 = d1 * s + p;
    p = p * s + (*this)[k];
  }
  return {p, d1, 2. * d2, 6. * d3};
}

vpPolynomial vpPolynomial::derivative() const noexcept
{
  vpPolynomial out;
  out.m_degree = std::max(m_degree - 1, 0);
  vpRootKernel::differentiate(m_c.data(), m_degree, out.m_c.data());
  return out;
}

vpPolynomial vpPolynomial::times(const vpPolynomial &other) const noexcept
{
  vpPolynomial out;
  out.m_degree = std::min(m_degree + other.m_degree, maxDegree);
  for (int i = 0; i <= m_degree; ++i) {
    for (int k = 0; k <= other.m_degree && i + k <= maxDegree; ++k) {
      out[i + k] += (*this)[i] * other[k];
    }
  }
  return out;
}

vpPolynomial vpPolynomial::composed(double offset, double scale) const noexcept
{
  // Horner with the linear polynomial (offset + scale u) in place of s.
  vpPolynomial out;
  out.m_degree = m_degree;
  for (int k = m_degree; k >= 0; --k) {
    for (int i = m_degree - k; i > 0; --i) {
      out[i] = out[i] * offset + out[i - 1] * scale;
    }
    out[0] = out[0] * offset + (*this)[k];
  }
  return out;
}

vpPolynomial::Points vpPolynomial::roots() const noexcept
{
  Points points;
  points.count = vpRootKernel::allRoots(m_c.data(), m_degree, points.s.data());
  return points;
}

vpPolynomial::Range vpPolynomial::range(double from, double to) const noexcept
{
  Range range;
  range.min = range.max = value(from);
  range.atMin = range.atMax = from;
  const auto consider = [&](double s) {
    const double p = value(s);
    if (p < range.min) {
      range.min = p;
      range.atMin = s;
    }
    if (p > range.max) {
      range.max = p;
      range.atMax = s;
    }
  };
  for (double s : derivative().roots()) {
    if (s > from && s < to) {
      consider(s);
    }
  }
  consider(to);
  return range;
}

END_VISP_NAMESPACE
