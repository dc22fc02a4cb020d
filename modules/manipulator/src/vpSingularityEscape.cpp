/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpSingularityEscape.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using vpTaskLevel::Joints;
using vpTaskLevel::Square;

// Eigenvectors (columns of V) and eigenvalues of the symmetric upper left d x d part, by Jacobi rotations: d is mostly
// 2 or 3.
void eigen(Square A, int d, Square &V, Joints &values)
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

namespace vpSingularityEscape
{
Square curvature(const vpArmModel &model, const vpArmData &data, vpArmFrame frame,
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

Room room(const vpTaskLevel::Basis &taken, const Joints &mayMove)
{
  constexpr double least = 0.01; // squared length of the remainder of a joint's own direction
  Room space;
  vpTaskLevel::Basis all = taken;
  // The basis is orthonormal: the remainder of unit vector i has the squared length 1 - sum v_k(i)^2.
  Joints left = Joints::Ones();
  for (int k = 0; k < all.count; ++k) {
    left -= all.vectors.col(k).cwiseAbs2();
  }
  for (;;) {
    // The joint with the largest remainder, so that the vectors are well defined.
    int joint = -1;
    double most = least;
    for (int i = 0; i < vpArmMaxJoints; ++i) {
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

bool direction(const Room &space, const Square &H, double sense, const Joints &slope, const Joints &motion, Joints &z)
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
    eigen(change * change.transpose(), d, V, values);
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
} // namespace vpSingularityEscape

END_VISP_NAMESPACE
