/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpMotionFamily.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Upper coefficients of the Hermite polynomial with m conditions at each end, from the residuals of the lower ones at
// s = 1: row = coefficient m, m + 1, ..., column = residual of the derivative 0, 1, ... The case m = 3 is (3.62).
constexpr double upper1[1][1] = {{1.}};
constexpr double upper2[2][2] = {{3., -1.}, {-2., 1.}};
constexpr double upper3[3][3] = {{10., -4., 0.5}, {-15., 7., -1.}, {6., -3., 0.5}};
constexpr double upper4[4][4] = {
    {35., -15., 2.5, -1. / 6.}, {-84., 39., -7., 0.5}, {70., -34., 6.5, -0.5}, {-20., 10., -2., 1. / 6.}};
constexpr double factorial[] = {1., 1., 2., 6.};

// Coefficients of the polynomial with M conditions at each end.
template <int M>
void hermiteCoefficients(const double (&upper)[M][M], const double *left, const double *right, double *out)
{
  double residual[M];
  for (int k = 0; k < M; ++k) {
    out[k] = left[k] / factorial[k];
    residual[k] = right[k];
    for (int i = k; i < M; ++i) {
      residual[k] -= left[i] / factorial[i - k];
    }
  }
  for (int row = 0; row < M; ++row) {
    out[M + row] = 0.;
    for (int k = 0; k < M; ++k) {
      out[M + row] += upper[row][k] * residual[k];
    }
  }
}

// The same where only the derivative of order k is given at both ends, the others are zero.
template <int M> void hermiteCoefficients(const double (&upper)[M][M], int k, double left, double right, double *out)
{
  double residual[M];
  for (int i = 0; i < M; ++i) {
    out[i] = i == k ? left / factorial[k] : 0.;
    residual[i] = i < k ? -left / factorial[k - i] : i == k ? right - left : 0.;
  }
  for (int row = 0; row < M; ++row) {
    double &x = out[M + row] = 0.;
    for (int i = 0; i < M; ++i) {
      x += upper[row][i] * residual[i];
    }
  }
}

void hermiteCoefficients(int order, int k, double left, double right, double *out)
{
  switch (order) {
  case 1:
    return hermiteCoefficients(upper1, k, left, right, out);
  case 2:
    return hermiteCoefficients(upper2, k, left, right, out);
  case 3:
    return hermiteCoefficients(upper3, k, left, right, out);
  default:
    return hermiteCoefficients(upper4, k, left, right, out);
  }
}

// Derivative of order d of s^k: factor and remaining power.
double fallingFactorial(int k, int d)
{
  double factor = 1.;
  for (int i = 0; i < d; ++i) {
    factor *= k - i;
  }
  return factor;
}
} // namespace

vpMotionFamily vpMotionFamily::hermite(const vpAxisState &from, const vpAxisState &to, int level, int order)
{
  vpMotionFamily family;
  family.m_degree = level + 2 * order - 1;
  family.m_power = level + order - 1;
  family.m_firstGiven = level;
  family.m_endGiven = level + order;
  // Each given derivative enters with its own power of T, so the power is also its column.
  for (int k = 0; k < order; ++k) {
    const int power = level + k;
    double out[8];
    const auto given = static_cast<std::size_t>(power);
    hermiteCoefficients(order, k, power == 0 ? 0. : from[given], power == 0 ? to[0] - from[0] : to[given], out);
    for (int i = 0; i < 2 * order; ++i) { // integrate `level` times
      family.m_c[static_cast<std::size_t>(i + level)][static_cast<std::size_t>(power)] =
          out[i] / fallingFactorial(i + level, level);
    }
  }
  for (int k = 1; k < level; ++k) {
    family.m_c[static_cast<std::size_t>(k)][static_cast<std::size_t>(k)] =
        from[static_cast<std::size_t>(k)] / factorial[k];
  }
  return family;
}

vpMotionFamily vpMotionFamily::pointToPoint(const vpAxisState &from, const vpAxisState &to, int order)
{
  if (order != 3) {
    return hermite(from, to, 0, order);
  }
  // (3.62): what is planned most often.
  const double h = to[0] - from[0], v0 = from[1], v1 = to[1], a0 = from[2], a1 = to[2];
  vpMotionFamily family;
  family.m_degree = 5;
  family.m_power = 2;
  family.m_endGiven = 3;
  family.m_c[1][1] = v0;
  family.m_c[2][2] = 0.5 * a0;
  family.m_c[3] = {10. * h, -6. * v0 - 4. * v1, 0.5 * a1 - 1.5 * a0, 0.};
  family.m_c[4] = {-15. * h, 8. * v0 + 7. * v1, 1.5 * a0 - a1, 0.};
  family.m_c[5] = {6. * h, -3. * (v0 + v1), 0.5 * (a1 - a0), 0.};
  return family;
}

vpMotionFamily vpMotionFamily::velocityStep(const vpAxisState &from, const vpAxisState &to, int order)
{
  if (order != 2) {
    return hermite(from, to, 1, order);
  }
  const double v0 = from[1], v1 = to[1], a0 = from[2], a1 = to[2];
  vpMotionFamily family; // the quartic ramps of the cruise form
  family.m_degree = 4;
  family.m_power = 2;
  family.m_firstGiven = 1;
  family.m_endGiven = 3;
  family.m_c[1][1] = v0;
  family.m_c[2][2] = 0.5 * a0;
  family.m_c[3] = {0., v1 - v0, -(2. * a0 + a1) / 3., 0.};
  family.m_c[4] = {0., 0.5 * (v0 - v1), 0.25 * (a0 + a1), 0.};
  return family;
}

vpMotionFamily vpMotionFamily::accelerationStep(const vpAxisState &from, const vpAxisState &to, int order)
{
  return hermite(from, to, 2, order);
}

vpMotionFamily vpMotionFamily::throughPosition(const vpAxisState &from, const vpAxisState &to, double via, double tau)
{
  vpMotionFamily family = pointToPoint(from, to, 3);
  std::array<std::array<double, maxPower + 1>, 3> targets{};
  targets[0][0] = via - from[0];
  family.addBump(tau, 1, targets);
  return family;
}

vpMotionFamily vpMotionFamily::throughPosition(const vpAxisState &from, const vpAxisState &to, double via, double tau,
                                               double velocityShare, double accelerationShare)
{
  const vpMotionFamily smooth = throughPosition(from, to, via, tau);
  std::array<std::array<double, maxPower + 1>, 3> targets{};
  targets[0][0] = via - from[0];
  targets[1] = smooth.inDuration(tau, 1);
  targets[2] = smooth.inDuration(tau, 2);
  for (std::size_t m = 0; m <= maxPower; ++m) {
    targets[1][m] *= velocityShare;
    targets[2][m] *= accelerationShare;
  }
  vpMotionFamily family = pointToPoint(from, to, 3);
  family.addBump(tau, 3, targets);
  return family;
}

vpMotionFamily vpMotionFamily::throughState(const vpAxisState &from, const vpAxisState &to, const vpAxisState &via,
                                            double tau)
{
  vpMotionFamily family = pointToPoint(from, to, 3);
  std::array<std::array<double, maxPower + 1>, 3> targets{};
  targets[0][0] = via[0] - from[0];
  targets[1][1] = via[1];
  targets[2][2] = via[2];
  family.addBump(tau, 3, targets);
  return family;
}

// Adds w(s) (k0 + k1 (s - tau) + k2 (s - tau)^2), w = s^3 (1 - s)^3, which leaves the ends unchanged up to the second
// derivative; the k follow one by one from the conditions at tau, power of T by power of T.
void vpMotionFamily::addBump(double tau, int count, const std::array<std::array<double, maxPower + 1>, 3> &targets)
{
  const vpPolynomial w{0., 0., 0., 1., -3., 3., -1.};
  const auto wJet = w.jet(tau);
  const vpPolynomial shift{-tau, 1.};
  const vpPolynomial basis[3] = {w, w.times(shift), w.times(shift).times(shift)};
  std::array<std::array<double, maxPower + 1>, 3> missing{};
  for (int d = 0; d < count; ++d) {
    const auto present = inDuration(tau, d);
    for (std::size_t m = 0; m <= maxPower; ++m) {
      missing[static_cast<std::size_t>(d)][m] = targets[static_cast<std::size_t>(d)][m] - present[m];
    }
  }
  m_degree = 5 + count;
  for (std::size_t m = 0; m <= 2; ++m) {
    const double k0 = missing[0][m] / wJet[0];
    const double k1 = count > 1 ? (missing[1][m] - k0 * wJet[1]) / wJet[0] : 0.;
    const double k2 = count > 2 ? (missing[2][m] - k0 * wJet[2] - 2. * k1 * wJet[1]) / (2. * wJet[0]) : 0.;
    for (int i = 3; i <= m_degree; ++i) {
      const auto at = [i](const vpPolynomial &p) { return i <= p.degree() ? p[i] : 0.; };
      m_c[static_cast<std::size_t>(i)][m] += k0 * at(basis[0]) + k1 * at(basis[1]) + k2 * at(basis[2]);
    }
  }
}

vpMotionFamily vpMotionFamily::chained(const std::array<std::array<double, 3>, 3> &from,
                                       const std::array<std::array<double, 3>, 3> &to, double share)
{
  vpMotionFamily family;
  family.m_degree = 5;
  family.m_power = 2;
  family.m_share = share;
  // The inner ends of a chain are computed, not given, so limits are checked there too.
  for (std::size_t m = 0; m <= 2; ++m) {
    const double left[3] = {from[0][m], from[1][m], from[2][m]}, right[3] = {to[0][m], to[1][m], to[2][m]};
    double out[6];
    hermiteCoefficients(upper3, left, right, out);
    for (std::size_t i = 0; i < 6; ++i) {
      family.m_c[i][m] = out[i];
    }
  }
  return family;
}

vpPolynomial vpMotionFamily::at(double T) const noexcept
{
  vpPolynomial p;
  p.setDegree(m_degree);
  double c[maxDegree + 1];
  evaluate(T, c);
  for (int k = 0; k <= m_degree; ++k) {
    p[k] = c[k];
  }
  return p;
}

void vpMotionFamily::evaluate(double T, double *c) const noexcept
{
  for (int k = 0; k <= m_degree; ++k) {
    const auto &row = m_c[static_cast<std::size_t>(k)];
    c[k] = ((row[3] * T + row[2]) * T + row[1]) * T + row[0];
  }
}

std::array<double, vpMotionFamily::maxPower + 1> vpMotionFamily::inDuration(double s, int derivative) const noexcept
{
  std::array<double, maxPower + 1> out{};
  for (int k = m_degree; k >= derivative; --k) {
    const double factor = fallingFactorial(k, derivative);
    const auto &row = m_c[static_cast<std::size_t>(k)];
    for (std::size_t m = 0; m <= maxPower; ++m) {
      out[m] = out[m] * s + factor * row[m];
    }
  }
  return out;
}

END_VISP_NAMESPACE
