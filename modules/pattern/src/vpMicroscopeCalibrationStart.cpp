/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMicroscopeCalibrationStart.h"

#include <Eigen/Dense>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double leastGap = 1e-3; // between the two smallest singular values of the radial alignment, over the largest

// The affine map d = A p + t, up to a factor that may be negative.
struct Affine {
  Eigen::Matrix2d A;
  Eigen::Vector2d t;
};

// u q - v p = 0 for (a, b, tx, c, d, ty); false when the solution is not unique.
bool alignRadially(const vpPlanarView &view, double unitD, double unitP, Affine &result)
{
  Eigen::MatrixXd rows(view.d.cols(), 6);
  for (Eigen::Index i = 0; i < view.d.cols(); ++i) {
    const Eigen::Vector2d d = view.d.col(i) / unitD, p = view.p.col(i) / unitP;
    rows.row(i) << d.y() * p.x(), d.y() * p.y(), d.y(), -d.x() * p.x(), -d.x() * p.y(), -d.x();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::VectorXd &s = svd.singularValues();
  if (!(s[4] > leastGap * s[0])) {
    return false;
  }
  const Eigen::VectorXd h = svd.matrixV().col(5);
  result.A << h[0] / unitP, h[1] / unitP, h[3] / unitP, h[4] / unitP;
  result.t << h[2], h[5];
  return std::abs(result.A.determinant()) > 0.05 * result.A.squaredNorm(); // a similarity has 0.5
}

Affine fitAffine(const vpPlanarView &view)
{
  Eigen::MatrixXd rows(view.p.cols(), 3);
  rows << view.p.transpose(), Eigen::VectorXd::Ones(view.p.cols());
  const Eigen::MatrixXd h = rows.colPivHouseholderQr().solve(view.d.transpose());
  return {h.topRows(2).transpose(), h.row(2).transpose()};
}
} // namespace

vpPlanarView vpMakePlanarView(const std::vector<vpCalibrationPoint> &points, double u0, double v0, double aspect)
{
  vpPlanarView view;
  const auto n = static_cast<Eigen::Index>(points.size());
  view.d.resize(2, n);
  view.p.resize(2, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const vpCalibrationPoint &point = points[static_cast<std::size_t>(i)];
    view.d.col(i) << point.u - u0, (point.v - v0) / aspect;
    view.p.col(i) << point.x, point.y;
  }
  view.origin = view.p.rowwise().mean();
  view.p.colwise() -= view.origin;
  return view;
}

vpPlanarStart vpStartPlanarView(vpPlanarView &view)
{
  const double unitD = std::sqrt(view.d.squaredNorm() / static_cast<double>(view.d.cols()));
  const double unitP = std::sqrt(view.p.squaredNorm() / static_cast<double>(view.p.cols()));
  Affine affine;
  if (!alignRadially(view, unitD, unitP, affine)) {
    affine = fitAffine(view);
  }
  if ((affine.A * view.p).cwiseProduct(view.d).sum() + affine.t.dot(view.d.rowwise().sum()) < 0.) {
    affine.A *= -1.; // points are seen on their own side, not opposite
    affine.t *= -1.;
  }
  view.mirrored = affine.A.determinant() < 0.;
  if (view.mirrored) {
    affine.A.col(1) *= -1.;
    view.p.row(1) *= -1.;
  }
  // The nearest scaled rotation.
  const double c = affine.A(0, 0) + affine.A(1, 1), s = affine.A(1, 0) - affine.A(0, 1);
  vpPlanarStart start;
  start.rotation = std::atan2(s, c);
  start.t = affine.t / (0.5 * std::hypot(c, s));
  return start;
}

vpPlanarScale vpStartPlanarScale(const std::vector<vpPlanarView> &views, const std::vector<vpPlanarStart> &starts,
                                 bool withKappa1)
{
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < views.size(); ++k) {
    const double c = std::cos(starts[k].rotation), s = std::sin(starts[k].rotation);
    Eigen::Matrix2d R;
    R << c, -s, s, c;
    for (Eigen::Index i = 0; i < views[k].d.cols(); ++i) {
      const Eigen::Vector2d d = views[k].d.col(i), pq = R * views[k].p.col(i) + starts[k].t;
      Eigen::Matrix2d rows;
      rows << pq, -d * d.squaredNorm();
      normal += rows.transpose() * rows;
      right += rows.transpose() * d;
    }
  }
  vpPlanarScale start;
  if (withKappa1) {
    const Eigen::Vector2d unit = normal.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::Vector2d solution =
        unit.asDiagonal() * (unit.asDiagonal() * normal * unit.asDiagonal()).ldlt().solve(unit.asDiagonal() * right);
    start.scale = solution[0];
    start.kappa1 = solution[1];
  }
  else {
    start.scale = right[0] / normal(0, 0);
  }
  return start;
}

END_VISP_NAMESPACE
