/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpHomographySpread.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

struct Normal {
  Matrix8 N = Matrix8::Zero();
  Vector8 b = Vector8::Zero();
  double squares = 0.;
};

// Normal equations of the distances in the frame.
Normal normalEquations(const Eigen::Matrix3d &G, const std::vector<Eigen::Vector2d> &x,
                       const std::vector<cv::Point2f> &to)
{
  Normal sum;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3d p = G * x[i].homogeneous();
    const Eigen::Vector2d r(to[i].x - p.x() / p.z(), to[i].y - p.y() / p.z());
    const Eigen::Matrix<double, 2, 8> J = homographyDerivative(G, x[i].x(), x[i].y());
    sum.N += J.transpose() * J;
    sum.b += J.transpose() * r;
    sum.squares += r.squaredNorm();
  }
  return sum;
}
} // namespace

Eigen::Matrix<double, 2, 8> homographyDerivative(const Eigen::Matrix3d &G, double x, double y)
{
  const Eigen::Vector3d X(x, y, 1.), p = G * X;
  const double u = p.x() / p.z(), v = p.y() / p.z();
  Eigen::Matrix<double, 2, 8> J = Eigen::Matrix<double, 2, 8>::Zero();
  J.block<1, 3>(0, 0) = X.transpose();
  J.block<1, 3>(1, 3) = X.transpose();
  J.block<1, 2>(0, 6) = -u * X.head<2>().transpose();
  J.block<1, 2>(1, 6) = -v * X.head<2>().transpose();
  return J / p.z();
}

vpHomographySpread::vpHomographySpread(const std::vector<cv::Point2f> &from, const std::vector<cv::Point2f> &to,
                                       const cv::Mat &start, double width, double height)
{
  constexpr int iterations = 10;       // quadratic convergence from RANSAC's result
  constexpr double determined = 1e-12; // smallest over largest eigenvalue: below it all digits are lost
  const double S = 0.5 * width;
  Eigen::Matrix3d back; // normalised coordinates to pixels
  back << S, 0., 0.5 * width, 0., S, 0.5 * height, 0., 0., 1.;
  std::vector<Eigen::Vector2d> x;
  for (const cv::Point2f &p : from) {
    x.emplace_back((p.x - 0.5 * width) / S, (p.y - 0.5 * height) / S);
  }
  for (int i = 0; i < 9; ++i) {
    G(i / 3, i % 3) = start.at<double>(i / 3, i % 3);
  }
  G = (G * back).eval();
  G /= G(2, 2);
  Normal normal = normalEquations(G, x, to);
  for (int i = 0; i < iterations; ++i) {
    const Vector8 step = normal.N.ldlt().solve(normal.b);
    Eigen::Matrix3d next = G;
    for (int k = 0; k < 8; ++k) {
      next(k / 3, k % 3) += step(k);
    }
    const Normal after = normalEquations(next, x, to);
    if (!(after.squares <= normal.squares)) {
      break;
    }
    const bool done = after.squares > (1. - 1e-9) * normal.squares;
    G = next;
    normal = after;
    if (done) {
      break;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Matrix8> solver(normal.N);
  known = G.allFinite() && normal.N.allFinite() &&
          solver.eigenvalues().minCoeff() > determined * solver.eigenvalues().maxCoeff();
  if (known) {
    const double s2 = normal.squares / (2. * static_cast<double>(x.size()) - 8.);
    sigma = std::sqrt(s2);
    covariance = s2 * solver.eigenvectors() * solver.eigenvalues().cwiseInverse().asDiagonal() *
                 solver.eigenvectors().transpose();
  }
}

END_VISP_NAMESPACE
