/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMicroscopeCalibrationProblem.h"
#include "vpCalibrationDistortion.h"

#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

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
  const std::array<double, vpMicroscopeState::SharedCount> &s = state.shared;
  const double scale = s[vpMicroscopeState::Scale], aspect = s[vpMicroscopeState::Aspect];
  if (!(scale > 0. && aspect > 0.)) {
    result.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
    return result;
  }
  const double c = std::cos(state.local[k][0]), sn = std::sin(state.local[k][0]);
  Eigen::Matrix2d R, dR, D;
  R << c, -sn, sn, c;
  dR << -sn, -c, c, -sn;
  D << 1. + s[vpMicroscopeState::Stretch], s[vpMicroscopeState::Shear], s[vpMicroscopeState::Shear],
      1. - s[vpMicroscopeState::Stretch];
  const Eigen::Vector2d tilt(s[vpMicroscopeState::TiltX], s[vpMicroscopeState::TiltY]);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d p = (*m_views)[k].p.col(i), turned = R * p;
    const Eigen::Vector2d q = scale * (D * turned) + state.local[k].tail<2>();
    const double depth = 1. + tilt.dot(q);
    if (!(depth > 0.)) {
      result.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
      return result;
    }
    const vpDistortedPoint seen = vpDistort(q / depth, s[vpMicroscopeState::Kappa1]);
    const Eigen::Matrix2d byQ =
        seen.byIdeal * (Eigen::Matrix2d::Identity() / depth - q * tilt.transpose() / (depth * depth));
    const Eigen::Vector2d inverse = sigma(k, static_cast<std::size_t>(i)).cwiseInverse();
    const Eigen::Vector2d toPixel(inverse.x(), inverse.y() * aspect); // of d
    const vpCalibrationPoint &point = (*m_points)[k][static_cast<std::size_t>(i)];
    result.residual[2 * i] = (point.u - s[vpMicroscopeState::U0] - seen.d.x()) * inverse.x();
    result.residual[2 * i + 1] = (point.v - s[vpMicroscopeState::V0] - aspect * seen.d.y()) * inverse.y();
    Eigen::Matrix<double, 2, vpMicroscopeState::SharedCount> byAll;
    byAll.col(vpMicroscopeState::Scale) = toPixel.asDiagonal() * byQ * (D * turned);
    byAll.col(vpMicroscopeState::Aspect) << 0., seen.d.y() * inverse.y();
    byAll.col(vpMicroscopeState::Kappa1) = toPixel.asDiagonal() * seen.byKappa1;
    byAll.col(vpMicroscopeState::U0) << inverse.x(), 0.;
    byAll.col(vpMicroscopeState::V0) << 0., inverse.y();
    const Eigen::Vector2d byDepth = toPixel.asDiagonal() * seen.byIdeal * (-q / (depth * depth));
    byAll.col(vpMicroscopeState::TiltX) = byDepth * q.x();
    byAll.col(vpMicroscopeState::TiltY) = byDepth * q.y();
    byAll.col(vpMicroscopeState::Stretch) =
        toPixel.asDiagonal() * byQ * Eigen::Vector2d(scale * turned.x(), -scale * turned.y());
    byAll.col(vpMicroscopeState::Shear) =
        toPixel.asDiagonal() * byQ * Eigen::Vector2d(scale * turned.y(), scale * turned.x());
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

END_VISP_NAMESPACE
