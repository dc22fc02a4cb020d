/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMicroscopeCalibrationCovariance.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using State = vpMicroscopeState;

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
