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
constexpr double infinity = std::numeric_limits<double>::infinity();

// The place of the greatest value of side p near one of five samples, by Newton steps on the derivative.
double greatestNear(const double *c, int degree, double side)
{
  constexpr double spacing = 0.25;
  double best = -infinity, s = 0.;
  for (int i = 0; i <= 4; ++i) {
    const double value = side * horner(c, degree, i * spacing);
    s = value > best ? i * spacing : s;
    best = std::max(best, value);
  }
  const double middle = s;
  for (int k = 0; k < 2; ++k) {
    double p = 0., slope = 0., half = 0.; // half the second derivative
    for (int i = degree; i >= 0; --i) {
      half = half * s + slope;
      slope = slope * s + p;
      p = p * s + c[i];
    }
    const double next = s - 0.5 * slope / half;
    s = next > middle - spacing && next < middle + spacing ? std::clamp(next, 0., 1.) : s;
  }
  return side * horner(c, degree, s) > best ? s : middle;
}
} // namespace

bool staysWithin(const double *c, int degree, double low, double high) noexcept
{
  double min = 0., max = 0.;
  enclose(c, degree, min, max);
  double sum = 0.;
  for (int k = 0; k <= degree; ++k) {
    sum += std::abs(c[k]);
  }
  const bool above = max > high, below = min < low;
  if (!above && !below) {
    return std::isfinite(sum);
  }
  // A value beyond is enough to know; rounding does not change it by slack.
  const double slack = 32. * epsilon * sum;
  if ((above && horner(c, degree, greatestNear(c, degree, 1.)) > high + slack) ||
      (below && horner(c, degree, greatestNear(c, degree, -1.)) < low - slack)) {
    return false;
  }
  extremes(c, degree, 0., min, max);
  return min >= low && max <= high;
}

void extremes(const double *c, int degree, double from, double &low, double &high) noexcept
{
  const double first = horner(c, degree, from), last = horner(c, degree, 1.);
  low = std::min(first, last);
  high = std::max(first, last);
  double slope[9], places[9];
  slope[0] = 0.;
  differentiate(c, degree, slope);
  const int count =
      degree <= 3 ? closedFormRoots(slope, degree - 1, places) : allRoots(slope, degree - 1, places, Wanted::Extrema);
  for (int i = 0; i < count; ++i) {
    const double value = horner(c, degree, std::max(places[i], from));
    low = std::min(low, value);
    high = std::max(high, value);
  }
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
    const double ratio = std::abs(c[degree - k] / c[degree]);
    bound = std::max(bound, 2. * (k == 1   ? ratio
                                  : k == 2 ? std::sqrt(ratio)
                                  : k == 3 ? std::cbrt(ratio)
                                           : std::pow(ratio, 1. / k)));
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
