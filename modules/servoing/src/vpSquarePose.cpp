/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpSquarePose.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
using Corners = std::array<Eigen::Vector2d, 4>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int iterations = 50;

std::array<Eigen::Vector3d, 4> square(double size)
{
  const double h = 0.5 * size;
  return {{{-h, -h, 0.}, {h, -h, 0.}, {h, h, 0.}, {-h, h, 0.}}};
}

// Normal equations of the residuals at a pose, moved by (v, w): P = exp(w) R X + t + v. False behind the camera.
bool linearise(const Corners &corners, double size, const vpRigidTransform &cMo, Matrix6 &A, Vector6 &b, double &cost)
{
  A.setZero();
  b.setZero();
  cost = 0.;
  const std::array<Eigen::Vector3d, 4> points = square(size);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d rotated = cMo.R * points[i], P = rotated + cMo.p;
    if (!(P.z() > 1e-6)) {
      return false;
    }
    const Eigen::Vector2d m = P.head<2>() / P.z(), residual = corners[i] - m;
    Eigen::Matrix<double, 2, 3> projection;
    projection << 1., 0., -m.x(), 0., 1., -m.y();
    projection /= P.z();
    Eigen::Matrix<double, 2, 6> J;
    J << projection, -projection * vpSO3::skew(rotated);
    A += J.transpose() * J;
    b += J.transpose() * residual;
    cost += residual.squaredNorm();
  }
  return true;
}

// Levenberg-Marquardt.
vpSquareFit refined(const Corners &corners, double size, double sigma, vpRigidTransform cMo)
{
  vpSquareFit fit;
  Matrix6 A;
  Vector6 b;
  double cost = 0., damping = 1e-3;
  if (!linearise(corners, size, cMo, A, b, cost)) {
    return fit;
  }
  for (int i = 0; i < iterations; ++i) {
    Matrix6 damped = A;
    damped.diagonal() *= 1. + damping;
    const Vector6 step = damped.ldlt().solve(b);
    const vpRigidTransform next{vpSO3::exp(step.tail<3>()) * cMo.R, cMo.p + step.head<3>()};
    Matrix6 nextA;
    Vector6 nextB;
    double nextCost = 0.;
    if (linearise(corners, size, next, nextA, nextB, nextCost) && nextCost <= cost) {
      const bool isDone = cost - nextCost <= 1e-9 * cost;
      cMo = next;
      A = nextA;
      b = nextB;
      cost = nextCost;
      damping = std::max(1e-9, 0.1 * damping);
      if (isDone) {
        break;
      }
    }
    else {
      damping *= 10.;
    }
  }
  fit.cMo = cMo;
  fit.misfit = cost / (sigma * sigma);
  const Matrix6 C = sigma * sigma * A.inverse();
  fit.isValid = C.allFinite() && cMo.p.allFinite() && (C.diagonal().array() > 0.).all();
  fit.covariance.known = fit.isValid;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(fit.covariance.C.data()) = C;
  return fit;
}

// Pose from the homography of the plane z = 0.
vpRigidTransform fromHomography(const Corners &corners, double size)
{
  const std::array<Eigen::Vector3d, 4> points = square(size);
  Eigen::Matrix<double, 8, 9> system;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::RowVector3d X(points[i].x(), points[i].y(), 1.), zero = Eigen::RowVector3d::Zero();
    const auto row = static_cast<Eigen::Index>(2 * i);
    system.row(row) << X, zero, -corners[i].x() * X;
    system.row(row + 1) << zero, X, -corners[i].y() * X;
  }
  const Eigen::Matrix<double, 9, 1> h =
      Eigen::JacobiSVD<Eigen::Matrix<double, 8, 9>>(system, Eigen::ComputeFullV).matrixV().col(8);
  Eigen::Matrix3d H;
  H << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(), h.segment<3>(6).transpose();
  H /= 0.5 * (H.col(0).norm() + H.col(1).norm()) * (H(2, 2) < 0. ? -1. : 1.);
  Eigen::Matrix3d R;
  R << H.col(0), H.col(1), H.col(0).cross(H.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU() * svd.matrixV().transpose(), H.col(2)};
}

// The plane's normal reflected about the line of sight: the other pose at weak perspective.
vpRigidTransform reflected(const vpRigidTransform &cMo)
{
  const Eigen::Vector3d sight = cMo.p.normalized(), normal = cMo.R.col(2);
  const Eigen::Vector3d other = 2. * sight.dot(normal) * sight - normal;
  return {vpSO3::minimalRotation(normal, other) * cMo.R, cMo.p};
}
} // namespace

vpSquarePoses vpFitSquare(const std::array<Eigen::Vector2d, 4> &corners, double size, double sigma)
{
  vpSquarePoses poses;
  const vpRigidTransform start = fromHomography(corners, size);
  if (!start.R.allFinite() || !(start.R.determinant() > 0.)) {
    return poses;
  }
  poses.best = refined(corners, size, sigma, start);
  if (!poses.best.isValid) {
    return poses;
  }
  poses.rival = refined(corners, size, sigma, reflected(poses.best.cMo));
  if (poses.rival.isValid && poses.rival.misfit < poses.best.misfit) {
    std::swap(poses.best, poses.rival);
  }
  // The same minimum again, or less apart than the noise.
  const double apart = vpSO3::log(poses.best.cMo.R.transpose() * poses.rival.cMo.R).norm();
  poses.rival.isValid = poses.rival.isValid && apart > 2. * poses.best.covariance.rotationDeviation();
  return poses;
}

END_VISP_NAMESPACE
