/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTsaiCalibrationStart.h"
#include "vpCalibrationInput.h"

#include <Eigen/Dense>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double leastGap = 1e-6; // of the two smallest singular values of the radial alignment, over the largest

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d &M)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

// Points are seen on their own side, not opposite.
double signOf(const vpTsaiView &view, const Eigen::Matrix<double, 2, 3> &rows, const Eigen::Vector2d &t)
{
  return ((rows * view.p).colwise() + t).cwiseProduct(view.d).sum() < 0. ? -1. : 1.;
}

vpTsaiPose alignBody(const vpTsaiView &view, const Eigen::VectorXd &h, double unit)
{
  Eigen::Matrix<double, 2, 3> rows;
  rows << h.segment<3>(0).transpose() / unit, h.segment<3>(4).transpose() / unit;
  Eigen::Vector2d t(h[3], h[7]);
  const double factor = signOf(view, rows, t) * 2. / (rows.row(0).norm() + rows.row(1).norm());
  Eigen::Matrix3d R;
  R.topRows<2>() = factor * rows;
  R.row(2) = R.row(0).cross(R.row(1));
  vpTsaiPose pose;
  pose.R = nearestRotation(R);
  pose.t << factor * t, 0.;
  return pose;
}

std::vector<vpTsaiPose> alignPlane(const vpTsaiView &view, const Eigen::VectorXd &h, double unit)
{
  Eigen::Matrix2d block; // of the rotation from the axes of the plane to the camera, up to a factor
  block << h[0] / unit, h[1] / unit, h[3] / unit, h[4] / unit;
  Eigen::Vector2d t(h[2], h[5]);
  // The singular values of the leading block of a rotation are 1 and |r33|.
  const double factor = 1. / Eigen::JacobiSVD<Eigen::Matrix2d>(block).singularValues()[0];
  block *= factor;
  t *= factor;
  const Eigen::Matrix<double, 2, 3> rows = block * view.axes.leftCols<2>().transpose();
  const double sign = signOf(view, rows, t);
  block *= sign;
  t *= sign;
  const double r31 = std::sqrt(std::max(0., 1. - block.col(0).squaredNorm()));
  double r32 = std::sqrt(std::max(0., 1. - block.col(1).squaredNorm()));
  if (block.col(0).dot(block.col(1)) > 0.) {
    r32 = -r32; // the columns are perpendicular
  }
  std::vector<vpTsaiPose> poses;
  for (const double tilt : {1., -1.}) {
    Eigen::Matrix3d R;
    R.col(0) << block.col(0), tilt * r31;
    R.col(1) << block.col(1), tilt * r32;
    R.col(2) = R.col(0).cross(R.col(1));
    vpTsaiPose pose;
    pose.R = nearestRotation(R) * view.axes.transpose();
    pose.t << t, 0.;
    poses.push_back(pose);
  }
  return poses;
}
} // namespace

vpTsaiView vpMakeTsaiView(const std::vector<vpCalibrationPoint> &points, double u0, double v0, double aspect)
{
  vpTsaiView view;
  const auto n = static_cast<Eigen::Index>(points.size());
  view.d.resize(2, n);
  view.p.resize(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const vpCalibrationPoint &point = points[static_cast<std::size_t>(i)];
    view.d.col(i) << point.u - u0, (point.v - v0) / aspect;
    view.p.col(i) << point.x, point.y, point.z;
  }
  const vpCalibrationSpread spread = vpSpreadOf(points);
  view.origin = spread.centre;
  view.p.colwise() -= spread.centre;
  view.planar = spread.isPlane();
  view.axes = spread.axes;
  return view;
}

std::vector<vpTsaiPose> vpAlignTsaiView(const vpTsaiView &view)
{
  const double unitD = std::sqrt(view.d.squaredNorm() / static_cast<double>(view.d.cols()));
  const double unit = std::sqrt(view.p.squaredNorm() / static_cast<double>(view.p.cols()));
  const Eigen::Index dimension = view.planar ? 2 : 3;
  // u q - v p = 0 for (r1, tx, r2, ty), in the axes of the plane where it is one.
  Eigen::MatrixXd rows(view.d.cols(), 2 * dimension + 2);
  for (Eigen::Index i = 0; i < view.d.cols(); ++i) {
    const Eigen::Vector2d d = view.d.col(i) / unitD;
    Eigen::VectorXd p = view.p.col(i) / unit;
    if (view.planar) {
      p = (view.axes.transpose() * p).head(2).eval();
    }
    rows.row(i) << d.y() * p.transpose(), d.y(), -d.x() * p.transpose(), -d.x();
  }
  Eigen::VectorXd h;
  if (!vpNullVector(rows, leastGap, h)) {
    return {};
  }
  if (view.planar) {
    return alignPlane(view, h, unit);
  }
  return {alignBody(view, h, unit)};
}

vpTsaiDepth vpFindTsaiDepth(const vpTsaiView &view, const vpTsaiPose &pose, double f)
{
  // f p - u tz = u w and f q - v tz = v w, with w the depth without tz.
  const Eigen::Matrix3Xd turned = (pose.R * view.p).colwise() + pose.t;
  Eigen::MatrixXd rows(2 * turned.cols(), 2);
  Eigen::VectorXd right(2 * turned.cols());
  for (Eigen::Index i = 0; i < turned.cols(); ++i) {
    for (const Eigen::Index axis : {0, 1}) {
      rows.row(2 * i + axis) << turned(axis, i), -view.d(axis, i);
      right[2 * i + axis] = view.d(axis, i) * turned(2, i);
    }
  }
  vpTsaiDepth depth;
  depth.f = f;
  if (f == 0.) {
    const Eigen::Vector2d unit = rows.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Eigen::Vector2d solution = unit.asDiagonal() * (rows * unit.asDiagonal()).colPivHouseholderQr().solve(right);
    depth.f = solution[0];
    depth.tz = solution[1];
  }
  else {
    depth.tz = rows.col(1).dot(right - f * rows.col(0)) / rows.col(1).squaredNorm();
  }
  const Eigen::RowVectorXd z = turned.row(2).array() + depth.tz;
  depth.sensible = depth.f > 0. && z.minCoeff() > 0. && std::isfinite(depth.f);
  if (depth.sensible) {
    const Eigen::Matrix2Xd seen = depth.f * (turned.topRows<2>() * z.cwiseInverse().asDiagonal());
    depth.misfit = std::sqrt((seen - view.d).squaredNorm() / static_cast<double>(view.d.cols()));
  }
  return depth;
}

END_VISP_NAMESPACE
