/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTaskLevel.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace vpTaskLevel
{
namespace
{
constexpr double rankless = 1e-6; // singular values below this count as zero
constexpr double exactRate = 50.; // 1/s

// B = L V with orthonormal rows V. False when a row depends on those before it.
bool gramSchmidt(const Rows &B, int rows, Rows &V, Eigen::Matrix<double, 6, 6> &L)
{
  for (int i = 0; i < rows; ++i) {
    Joints v = B.col(i);
    for (int j = 0; j < i; ++j) {
      L(i, j) = V.col(j).dot(v);
      v -= L(i, j) * V.col(j);
    }
    L(i, i) = v.norm();
    if (!(L(i, i) > rankless)) {
      return false;
    }
    V.col(i) = v / L(i, i);
  }
  return true;
}

// One-sided Jacobi: rotates the rows of B until they are perpendicular, B = U^T ... ; their lengths are the singular
// values.
void jacobi(Rows &B, int rows, Eigen::Matrix<double, 6, 6> &U)
{
  U.setIdentity();
  for (int sweep = 0; sweep < 12; ++sweep) {
    double largest = 0.;
    for (int i = 0; i < rows; ++i) {
      for (int j = i + 1; j < rows; ++j) {
        const double a = B.col(i).squaredNorm(), b = B.col(j).squaredNorm(), c = B.col(i).dot(B.col(j));
        if (std::fabs(c) <= 1e-15 * std::sqrt(a * b) || c == 0.) {
          continue;
        }
        largest = std::max(largest, std::fabs(c) / std::sqrt(a * b));
        const double zeta = (b - a) / (2. * c);
        const double t = std::copysign(1., zeta) / (std::fabs(zeta) + std::sqrt(1. + zeta * zeta));
        const double cosine = 1. / std::sqrt(1. + t * t), sine = cosine * t;
        const Joints x = B.col(i);
        B.col(i) = cosine * x - sine * B.col(j);
        B.col(j) = sine * x + cosine * B.col(j);
        const Task u = U.col(i);
        U.col(i) = cosine * u - sine * U.col(j);
        U.col(j) = sine * u + cosine * U.col(j);
      }
    }
    if (largest < 1e-8) {
      break; // converges quadratically: this sweep was the last one needed
    }
  }
}
} // namespace

Info solve(const Rows &B, const Task &r, int rows, const Options &options, Basis &basis, Joints &y)
{
  Info info;
  if (rows == 0) {
    return info;
  }
  Rows free;
  Task rest = Task::Zero();
  for (int i = 0; i < rows; ++i) {
    free.col(i) = basis.count == 0 ? Joints(B.col(i)) : basis.free(B.col(i));
    rest(i) = r(i) - B.col(i).dot(y);
  }
  Rows V;
  Eigen::Matrix<double, 6, 6> L;
  if (gramSchmidt(free, rows, V, L)) {
    // 1 / |L^-1|^2 is a lower bound of the smallest singular value squared.
    double sum = 0.;
    for (int j = 0; j < rows; ++j) {
      Task column = Task::Zero();
      for (int i = j; i < rows; ++i) {
        double value = i == j ? 1. : 0.;
        for (int k = j; k < i; ++k) {
          value -= L(i, k) * column(k);
        }
        column(i) = value / L(i, i);
        sum += column(i) * column(i);
      }
    }
    info.smallest = 1. / std::sqrt(sum);
    if (info.smallest >= options.singularRegion) {
      Task c;
      for (int i = 0; i < rows; ++i) {
        double value = rest(i);
        for (int k = 0; k < i; ++k) {
          value -= L(i, k) * c(k);
        }
        c(i) = value / L(i, i);
        y += V.col(i) * c(i);
        basis.add(V.col(i));
      }
      return info;
    }
  }
  Eigen::Matrix<double, 6, 6> U;
  jacobi(free, rows, U);
  info.smallest = options.singularRegion;
  const Joints before = y;
  Joints motion = Joints::Zero();
  for (int i = 0; i < rows; ++i) {
    const double s = free.col(i).norm();
    if (s < info.smallest) {
      info.smallest = s;
      info.lost = U.col(i);
      info.singular = true;
    }
    if (s > rankless) {
      // Damping sets in smoothly below s0, only in the direction that needs it, and only as far as the demand requires:
      // a small demand is fulfilled exactly, at a speed of at most exactRate * s, at which s itself changes little in a
      // period.
      const double ratio = s / options.singularRegion, demand = U.col(i).dot(rest);
      const double most = ratio < 1. ? options.damping * (1. - ratio * ratio) : 0.;
      const double lambda2 = std::min(most * most, std::max(0., std::fabs(demand) / exactRate - s * s));
      const Joints v = free.col(i) / s;
      motion += v * (demand * s / (s * s + lambda2));
      basis.add(v);
    }
  }
  y = before + motion;
  return info;
}
} // namespace vpTaskLevel

END_VISP_NAMESPACE
