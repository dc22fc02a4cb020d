/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTaskLevel.h"

#include <algorithm>
#include <array>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Task = Eigen::Matrix<double, 6, 1>;

constexpr double rankless = 1e-6; // singular values below this count as zero
constexpr double exactRate = 50.; // 1/s

// B = L V with orthonormal rows V. False when a row depends on those before it.
template <class Rows> bool gramSchmidt(const Rows &B, int rows, Rows &V, Eigen::Matrix<double, 6, 6> &L)
{
  for (int i = 0; i < rows; ++i) {
    typename Rows::ColXpr::PlainObject v = B.col(i);
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
template <class Rows> void jacobi(Rows &B, int rows, Eigen::Matrix<double, 6, 6> &U)
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
        const typename Rows::ColXpr::PlainObject x = B.col(i);
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

template <int N>
typename vpTaskLevel<N>::Info vpTaskLevel<N>::solve(const Rows &B, const Task &r, int rows, const Options &options,
                                                    Basis &basis, Joints &y)
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
  if (options.lacking == 0 && gramSchmidt(free, rows, V, L)) {
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
  std::array<bool, 6> lacks{};
  for (int k = 0; k < options.lacking; ++k) {
    int least = -1;
    for (int i = 0; i < rows; ++i) {
      if (!lacks[static_cast<std::size_t>(i)] &&
          (least < 0 || free.col(i).squaredNorm() < free.col(least).squaredNorm())) {
        least = i;
      }
    }
    lacks[static_cast<std::size_t>(least)] = true;
    info.lacking.col(k) = U.col(least);
  }
  const Joints before = y;
  Joints motion = Joints::Zero();
  for (int i = 0; i < rows; ++i) {
    const double s = free.col(i).norm();
    if (lacks[static_cast<std::size_t>(i)]) {
      continue;
    }
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

namespace
{
// Eigenvectors (columns of V) and eigenvalues of the symmetric upper left d x d part, by Jacobi rotations: d is mostly
// 2 or 3.
template <class Square, class Joints> void eigen(Square A, int d, Square &V, Joints &values)
{
  V.setIdentity();
  for (int sweep = 0; sweep < 20; ++sweep) {
    double off = 0.;
    for (int i = 0; i < d; ++i) {
      for (int j = i + 1; j < d; ++j) {
        const double c = A(i, j);
        off = std::max(off, std::fabs(c));
        if (c == 0.) {
          continue;
        }
        const double theta = (A(j, j) - A(i, i)) / (2. * c);
        const double t = std::copysign(1., theta) / (std::fabs(theta) + std::sqrt(1. + theta * theta));
        const double cosine = 1. / std::sqrt(1. + t * t), sine = t * cosine;
        for (Square *M : {&A, &V}) {
          const Joints x = M->col(i);
          M->col(i) = cosine * x - sine * M->col(j);
          M->col(j) = sine * x + cosine * M->col(j);
        }
        const Joints row = A.row(i).transpose();
        A.row(i) = (cosine * row - sine * A.row(j).transpose()).transpose();
        A.row(j) = (sine * row + cosine * A.row(j).transpose()).transpose();
      }
    }
    if (off < 1e-14) {
      break;
    }
  }
  values = A.diagonal();
}
} // namespace

template <int N>
typename vpSingularityEscape<N>::Square
vpSingularityEscape<N>::curvature(const vpArmModel &model, const vpArmData &data, vpArmFrame frame,
                                  const Eigen::Matrix<double, 6, 1> &lost, const Joints &scale)
{
  Square H = Square::Zero();
  for (int k = 0; k < data.size; ++k) {
    const vpArmJacobian D = vpArmKinematics::derivative(model, data, k, frame);
    for (int l = 0; l < data.size; ++l) {
      H(k, l) = scale(k) * scale(l) * lost.dot(D.col(l));
    }
  }
  return H;
}

template <int N>
typename vpSingularityEscape<N>::Room vpSingularityEscape<N>::room(const typename Level::Basis &taken,
                                                                   const Joints &mayMove)
{
  constexpr double least = 0.01; // squared length of the remainder of a joint's own direction
  Room space;
  typename Level::Basis all = taken;
  // The basis is orthonormal: the remainder of unit vector i has the squared length 1 - sum v_k(i)^2.
  Joints left = Joints::Ones();
  for (int k = 0; k < all.count; ++k) {
    left -= all.vectors.col(k).cwiseAbs2();
  }
  for (;;) {
    // The joint with the largest remainder, so that the vectors are well defined.
    int joint = -1;
    double most = least;
    for (int i = 0; i < N; ++i) {
      if (mayMove(i) > 0. && left(i) > most) {
        most = left(i);
        joint = i;
      }
    }
    if (joint < 0) {
      return space;
    }
    const Joints best = all.free(Joints::Unit(joint)).normalized();
    all.add(best);
    left -= best.cwiseAbs2();
    space.vectors.col(space.count++) = best;
  }
}

template <int N>
bool vpSingularityEscape<N>::direction(const Room &space, const Square &H, double sense, const Joints &slope,
                                       const Joints &motion, Joints &z)
{
  const int d = space.count;
  if (d == 0) {
    return false;
  }
  const double flat = 1e-3 * (1e-3 + H.cwiseAbs().maxCoeff());
  const Square symmetric = 0.5 * sense * (H + H.transpose());
  // All in the coordinates of the space; zeros beyond d.
  const Joints pull = space.vectors.transpose() * (symmetric * motion); // gain of the motion by a self-motion
  const Square inside = space.vectors.transpose() * symmetric * space.vectors;
  Square V;
  Joints values;
  eigen(inside, d, V, values);
  int top = 0;
  Square neutral = Square::Zero(); // self-motion that does not bend the arm away from the demand
  for (int i = 0; i < d; ++i) {
    top = values(i) > values(top) ? i : top;
    if (values(i) > -flat) {
      neutral += V.col(i) * V.col(i).transpose();
    }
  }
  const Joints turning = neutral * pull;
  if (values(top) > flat) {
    // Bends the arm: moves along the demand for either sign.
    z = V.col(top);
  }
  else if (turning.norm() > flat * std::max(1e-3, motion.norm())) {
    // Turns the lost direction away from the demand.
    z = space.vectors * turning.normalized();
    return true;
  }
  else {
    // The demand is the lost direction itself: turn it, with either sign.
    const Square change = neutral * (space.vectors.transpose() * H);
    eigen<Square>(change * change.transpose(), d, V, values);
    top = 0;
    for (int i = 1; i < d; ++i) {
      top = values(i) > values(top) ? i : top;
    }
    if (values(top) < flat * flat) {
      return false;
    }
    z = V.col(top);
  }
  const double second = pull.dot(z);
  z = (space.vectors * z).eval();
  // Choose the sign that already serves the demand, so that the arm does not reverse on its way out.
  const double first = sense * slope.dot(z);
  if ((std::fabs(first) > 1e-6 ? first : second) < 0.) {
    z = -z;
  }
  return true;
}

template struct vpTaskLevel<8>;
template struct vpTaskLevel<vpArmMaxJoints>;
template struct vpSingularityEscape<8>;
template struct vpSingularityEscape<vpArmMaxJoints>;

END_VISP_NAMESPACE
