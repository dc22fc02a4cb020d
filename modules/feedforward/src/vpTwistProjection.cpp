/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpTwistProjection.h>

#include <Eigen/Jacobi>

#include <cmath>
#include <limits>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
// A row counts as violated beyond this, in units of the unknowns (rows have unit length).
constexpr double violation = 1e-10;
// A row whose part outside the span of the active ones is shorter than this counts as linearly dependent.
constexpr double dependence = 1e-9;
// Every pass adds or drops a row; real problems take fewer than ten passes.
constexpr int maxPasses = 500;
} // namespace

bool vpTwistProjection::addRow(const Vector &a, double b) noexcept
{
  const double length = a.norm();
  if (m_rowCount == capacity || !std::isfinite(length) || !std::isfinite(b)) {
    return false;
  }
  // A row of zeros means 0 >= b, true or false for every x; solve() handles it.
  const double scale = length > 0. ? 1. / length : 1.;
  m_a.col(m_rowCount) = a * scale;
  m_b[m_rowCount] = b * scale;
  ++m_rowCount;
  return true;
}

int vpTwistProjection::mostViolatedRow() const noexcept
{
  int worst = -1;
  double lowest = -violation;
  for (int i = 0; i < m_rowCount; ++i) {
    const double slack = m_a.col(i).dot(m_x) - m_b[i];
    if (slack < lowest * (1. + std::abs(m_b[i]))) {
      bool active = false;
      for (int k = 0; k < m_activeCount; ++k) {
        active = active || m_active[k] == i;
      }
      if (!active) {
        lowest = slack;
        worst = i;
      }
    }
  }
  return worst;
}

void vpTwistProjection::activate(int row, double multiplier) noexcept
{
  // Rotate the part of d beyond the active columns into one entry, which extends R by a column.
  for (int k = 5; k > m_activeCount; --k) {
    Eigen::JacobiRotation<double> turn;
    double length;
    turn.makeGivens(m_d[k - 1], m_d[k], &length);
    m_d[k - 1] = length;
    m_d[k] = 0.;
    m_J.applyOnTheRight(k - 1, k, turn);
  }
  m_R.col(m_activeCount) = m_d;
  m_active[m_activeCount] = row;
  m_multipliers[m_activeCount] = multiplier;
  ++m_activeCount;
}

void vpTwistProjection::deactivate(int position) noexcept
{
  for (int k = position; k + 1 < m_activeCount; ++k) {
    m_R.col(k) = m_R.col(k + 1);
    m_active[k] = m_active[k + 1];
    m_multipliers[k] = m_multipliers[k + 1];
  }
  --m_activeCount;
  // R is now Hessenberg from that column on: make it triangular again.
  for (int k = position; k < m_activeCount; ++k) {
    Eigen::JacobiRotation<double> turn;
    turn.makeGivens(m_R(k, k), m_R(k + 1, k));
    m_R.applyOnTheLeft(k, k + 1, turn.adjoint());
    m_J.applyOnTheRight(k, k + 1, turn);
  }
}

vpTwistProjection::Result vpTwistProjection::solve(const Vector &x0) noexcept
{
  m_x = x0;
  m_activeCount = 0;
  if (!x0.allFinite()) {
    return Result::NotConverged;
  }
  m_J.setIdentity();
  m_R.setZero();

  int row = mostViolatedRow();
  double multiplier = 0.; // of the row being added
  for (int pass = 0; pass < maxPasses; ++pass) {
    if (row < 0) {
      return m_x.allFinite() ? Result::Solved : Result::NotConverged;
    }
    // Primal direction z: the row's part outside the span of the active rows. Dual direction r: how the active
    // multipliers change with the new one.
    m_d.noalias() = m_J.transpose() * m_a.col(row);
    const int free = 6 - m_activeCount;
    const Vector z = m_J.rightCols(free) * m_d.tail(free);
    Vector r = m_d;
    for (int i = m_activeCount - 1; i >= 0; --i) {
      for (int k = i + 1; k < m_activeCount; ++k) {
        r[i] -= m_R(i, k) * r[k];
      }
      r[i] /= m_R(i, i);
    }
    const double slope = m_d.tail(free).squaredNorm(); // 0 when no direction is free

    double dualStep = infinity;
    int blocking = -1;
    for (int k = 0; k < m_activeCount; ++k) {
      if (r[k] > 0. && m_multipliers[k] < dualStep * r[k]) {
        dualStep = m_multipliers[k] / r[k];
        blocking = k;
      }
    }
    const double slack = m_a.col(row).dot(m_x) - m_b[row];
    const double primalStep = slope > dependence * dependence ? -slack / slope : infinity;
    if (blocking < 0 && primalStep == infinity) {
      return Result::Infeasible;
    }
    const double step = std::min(dualStep, primalStep);
    if (primalStep != infinity) {
      m_x += step * z;
    }
    m_multipliers.head(m_activeCount) -= step * r.head(m_activeCount);
    multiplier += step;
    if (primalStep <= dualStep) {
      activate(row, multiplier);
      row = mostViolatedRow();
      multiplier = 0.;
    }
    else {
      deactivate(blocking);
    }
  }
  return Result::NotConverged;
}

END_VISP_NAMESPACE
