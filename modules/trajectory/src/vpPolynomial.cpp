/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpRootKernel.h"

#include <visp3/trajectory/vpPolynomial.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

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
