/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMicroscopeCalibrationProblem.h"

#include "vpCalibrationInput.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
using State = vpMicroscopeState;

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
  Eigen::VectorXd h;
  if (!vpNullVector(rows, leastGap, h)) {
    return false;
  }
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

constexpr int localCount = 3;
constexpr int stateCount = State::SharedCount + localCount;

using StateMatrix = Eigen::Matrix<double, stateCount, stateCount>;

// Covariance of (all shared, local k), zero for given parameters.
StateMatrix stateCovariance(const vpBundleSolution<State> &solution, const std::vector<int> &isFree, std::size_t k)
{
  StateMatrix all = StateMatrix::Zero();
  for (std::size_t i = 0; i < isFree.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < isFree.size(); ++j) {
      all(isFree[i], isFree[j]) = solution.sharedCovariance(row, static_cast<Eigen::Index>(j));
    }
    all.block<1, localCount>(isFree[i], State::SharedCount) = solution.crossCovariance[k].row(row);
    all.block<localCount, 1>(State::SharedCount, isFree[i]) = solution.crossCovariance[k].row(row).transpose();
  }
  all.bottomRightCorner<localCount, localCount>() = solution.localCovariance[k];
  return all;
}

Eigen::Vector2d originOf(const vpPlanarView &view)
{
  return {view.origin.x(), view.mirrored ? -view.origin.y() : view.origin.y()};
}

// Derivatives of vpMicroscopeParameter by (all shared, local k): t = place / scale - D R F origin.
Eigen::Matrix<double, vpMicroscopeParameterCount, stateCount> resultBy(const State &state, const vpPlanarView &view,
                                                                       std::size_t k)
{
  Eigen::Matrix<double, vpMicroscopeParameterCount, stateCount> by;
  by.setZero();
  const double scale = state.shared[State::Scale], a = state.shared[State::Stretch], b = state.shared[State::Shear];
  by(vpMicroscopeScaleX, State::Scale) = 1.;
  by(vpMicroscopeScaleY, State::Scale) = state.shared[State::Aspect];
  by(vpMicroscopeScaleY, State::Aspect) = scale;
  by(vpMicroscopeKappa1, State::Kappa1) = 1.;
  by(vpMicroscopeU0, State::U0) = 1.;
  by(vpMicroscopeV0, State::V0) = 1.;
  by(vpMicroscopeTiltX, State::TiltX) = 1.;
  by(vpMicroscopeTiltY, State::TiltY) = 1.;
  by(vpMicroscopeStretch, State::Stretch) = 1.;
  by(vpMicroscopeShear, State::Shear) = 1.;
  const double c = std::cos(state.local[k][0]), s = std::sin(state.local[k][0]);
  const Eigen::Vector2d origin = originOf(view);
  const Eigen::Vector2d o(c * origin.x() - s * origin.y(), s * origin.x() + c * origin.y()), turned(-o.y(), o.x());
  const int rotation = State::SharedCount;
  by(vpMicroscopeRotation, rotation) = 1.;
  by.block<2, 1>(vpMicroscopeTx, State::Scale) = -state.local[k].tail<2>() / (scale * scale);
  by.block<2, 1>(vpMicroscopeTx, State::Stretch) << -o.x(), o.y();
  by.block<2, 1>(vpMicroscopeTx, State::Shear) << -o.y(), -o.x();
  by.block<2, 1>(vpMicroscopeTx, rotation) << -(1. + a) * turned.x() - b * turned.y(),
      -b * turned.x() - (1. - a) * turned.y();
  by.block<2, 2>(vpMicroscopeTx, rotation + 1) = Eigen::Matrix2d::Identity() / scale;
  return by;
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

Eigen::Vector2d vpMicroscopeProblem::sigma(std::size_t k, std::size_t i) const
{
  const vpCalibrationPoint &point = (*m_points)[k][i];
  return {std::hypot(point.sigmaU, m_scale * point.sigmaPlane), std::hypot(point.sigmaV, m_scale * point.sigmaPlane)};
}

vpBundleView vpMicroscopeProblem::view(const vpMicroscopeState &state, std::size_t k) const
{
  const auto n = static_cast<Eigen::Index>((*m_points)[k].size());
  vpBundleView result;
  result.byShared.resize(2 * n, shared());
  result.byLocal.resize(2 * n, 3);
  result.residual.resize(2 * n);
  const std::array<double, State::SharedCount> &s = state.shared;
  const double scale = s[State::Scale], aspect = s[State::Aspect];
  if (!(scale > 0. && aspect > 0.)) {
    result.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
    return result;
  }
  const double c = std::cos(state.local[k][0]), sn = std::sin(state.local[k][0]);
  Eigen::Matrix2d R, dR, D;
  R << c, -sn, sn, c;
  dR << -sn, -c, c, -sn;
  D << 1. + s[State::Stretch], s[State::Shear], s[State::Shear], 1. - s[State::Stretch];
  const Eigen::Vector2d tilt(s[State::TiltX], s[State::TiltY]);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d p = (*m_views)[k].p.col(i), turned = R * p;
    const Eigen::Vector2d q = scale * (D * turned) + state.local[k].tail<2>();
    const double depth = 1. + tilt.dot(q);
    if (!(depth > 0.)) {
      result.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
      return result;
    }
    const vpDistortedPoint seen = vpDistort(q / depth, s[State::Kappa1]);
    const Eigen::Matrix2d byQ =
        seen.byIdeal * (Eigen::Matrix2d::Identity() / depth - q * tilt.transpose() / (depth * depth));
    const Eigen::Vector2d inverse = sigma(k, static_cast<std::size_t>(i)).cwiseInverse();
    const Eigen::Vector2d toPixel(inverse.x(), inverse.y() * aspect); // of d
    const vpCalibrationPoint &point = (*m_points)[k][static_cast<std::size_t>(i)];
    result.residual[2 * i] = (point.u - s[State::U0] - seen.d.x()) * inverse.x();
    result.residual[2 * i + 1] = (point.v - s[State::V0] - aspect * seen.d.y()) * inverse.y();
    Eigen::Matrix<double, 2, State::SharedCount> byAll;
    byAll.col(State::Scale) = toPixel.asDiagonal() * byQ * (D * turned);
    byAll.col(State::Aspect) << 0., seen.d.y() * inverse.y();
    byAll.col(State::Kappa1) = toPixel.asDiagonal() * seen.byKappa1;
    byAll.col(State::U0) << inverse.x(), 0.;
    byAll.col(State::V0) << 0., inverse.y();
    const Eigen::Vector2d byDepth = toPixel.asDiagonal() * seen.byIdeal * (-q / (depth * depth));
    byAll.col(State::TiltX) = byDepth * q.x();
    byAll.col(State::TiltY) = byDepth * q.y();
    byAll.col(State::Stretch) = toPixel.asDiagonal() * byQ * Eigen::Vector2d(scale * turned.x(), -scale * turned.y());
    byAll.col(State::Shear) = toPixel.asDiagonal() * byQ * Eigen::Vector2d(scale * turned.y(), scale * turned.x());
    for (std::size_t j = 0; j < m_free.size(); ++j) {
      result.byShared.block<2, 1>(2 * i, static_cast<Eigen::Index>(j)) = byAll.col(m_free[j]);
    }
    result.byLocal.block<2, 1>(2 * i, 0) = toPixel.asDiagonal() * byQ * (scale * (D * (dR * p)));
    result.byLocal.block<2, 2>(2 * i, 1) = toPixel.asDiagonal() * byQ;
  }
  return result;
}

vpMicroscopeState vpMicroscopeProblem::plus(const vpMicroscopeState &state, const Eigen::VectorXd &shared,
                                            const std::vector<Eigen::VectorXd> &local) const
{
  vpMicroscopeState next = state;
  for (std::size_t j = 0; j < m_free.size(); ++j) {
    next.shared[static_cast<std::size_t>(m_free[j])] += shared[static_cast<Eigen::Index>(j)];
  }
  for (std::size_t k = 0; k < local.size(); ++k) {
    next.local[k] += local[k];
  }
  return next;
}

vpMicroscopePlacement vpMicroscopePlaceOf(const vpMicroscopeState &state, const vpPlanarView &view, std::size_t k)
{
  const double scale = state.shared[State::Scale], a = state.shared[State::Stretch], b = state.shared[State::Shear];
  const double c = std::cos(state.local[k][0]), s = std::sin(state.local[k][0]);
  const Eigen::Vector2d origin = originOf(view);
  const Eigen::Vector2d o(c * origin.x() - s * origin.y(), s * origin.x() + c * origin.y());
  vpMicroscopePlacement placement;
  placement.rotation = std::remainder(state.local[k][0], 2. * M_PI);
  placement.tx = state.local[k][1] / scale - ((1. + a) * o.x() + b * o.y());
  placement.ty = state.local[k][2] / scale - (b * o.x() + (1. - a) * o.y());
  placement.covariance.setZero();
  return placement;
}

vpMicroscopeCalibration vpMicroscopeCalibrationOf(const vpMicroscopeState &state, const vpPlanarView &first,
                                                  unsigned int width, unsigned int height)
{
  vpMicroscopeCalibration calibration;
  calibration.width = width;
  calibration.height = height;
  calibration.scaleX = state.shared[State::Scale];
  calibration.scaleY = state.shared[State::Scale] * state.shared[State::Aspect];
  calibration.kappa1 = state.shared[State::Kappa1];
  calibration.u0 = state.shared[State::U0];
  calibration.v0 = state.shared[State::V0];
  calibration.tiltX = state.shared[State::TiltX];
  calibration.tiltY = state.shared[State::TiltY];
  calibration.stretch = state.shared[State::Stretch];
  calibration.shear = state.shared[State::Shear];
  calibration.mirrored = first.mirrored;
  const vpMicroscopePlacement placement = vpMicroscopePlaceOf(state, first, 0);
  calibration.rotation = placement.rotation;
  calibration.tx = placement.tx;
  calibration.ty = placement.ty;
  return calibration;
}

vpMicroscopeCovariance vpMicroscopeCovarianceOf(const vpBundleSolution<vpMicroscopeState> &solution,
                                                const std::vector<int> &isFree, const vpPlanarView &view, std::size_t k)
{
  const auto by = resultBy(solution.state, view, k);
  return by * stateCovariance(solution, isFree, k) * by.transpose();
}

END_VISP_NAMESPACE
