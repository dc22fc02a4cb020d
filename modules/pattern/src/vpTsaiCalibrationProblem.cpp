/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTsaiCalibrationProblem.h"
#include "vpCalibrationDistortion.h"

#include <visp3/direct_core/vpSO3.h>

#include <limits>

BEGIN_VISP_NAMESPACE

vpBundleView vpTsaiProblem::view(const vpTsaiState &state, std::size_t k) const
{
  const std::vector<vpCalibrationPoint> &points = (*m_points)[k];
  const auto n = static_cast<Eigen::Index>(points.size());
  vpBundleView result;
  result.byShared.setZero(2 * n, shared());
  result.byLocal.setZero(2 * n, 6);
  result.residual.resize(2 * n);
  const double f = state.shared[vpTsaiState::F], aspect = state.shared[vpTsaiState::Aspect];
  const vpTsaiPose &pose = state.poses[k];
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d turned = pose.R * (*m_views)[k].p.col(i), p = turned + pose.t;
    if (!(f > 0. && aspect > 0. && p.z() > 0.)) {
      result.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
      return result;
    }
    const Eigen::Vector2d normalised = p.head<2>() / p.z();
    const vpDistortedPoint seen = vpDistort(f * normalised, state.shared[vpTsaiState::Kappa1]);
    const vpCalibrationPoint &point = points[static_cast<std::size_t>(i)];
    result.residual[2 * i] = (point.u - state.shared[vpTsaiState::U0] - seen.d.x()) / point.sigmaU;
    result.residual[2 * i + 1] = (point.v - state.shared[vpTsaiState::V0] - aspect * seen.d.y()) / point.sigmaV;
    const Eigen::Vector2d toPixel(1. / point.sigmaU, aspect / point.sigmaV); // of d
    Eigen::Matrix<double, 2, vpTsaiState::SharedCount> byAll;
    byAll.col(vpTsaiState::F) = toPixel.asDiagonal() * seen.byIdeal * normalised;
    byAll.col(vpTsaiState::Aspect) << 0., seen.d.y() / point.sigmaV;
    byAll.col(vpTsaiState::Kappa1) = toPixel.asDiagonal() * seen.byKappa1;
    byAll.col(vpTsaiState::U0) << 1. / point.sigmaU, 0.;
    byAll.col(vpTsaiState::V0) << 0., 1. / point.sigmaV;
    for (std::size_t j = 0; j < m_free.size(); ++j) {
      result.byShared.block<2, 1>(2 * i, static_cast<Eigen::Index>(j)) = byAll.col(m_free[j]);
    }
    Eigen::Matrix<double, 2, 3> projection;
    projection << 1., 0., -normalised.x(), 0., 1., -normalised.y();
    const Eigen::Matrix<double, 2, 3> byPoint = toPixel.asDiagonal() * seen.byIdeal * (f / p.z()) * projection;
    result.byLocal.block<2, 3>(2 * i, 0) = -byPoint * vpSO3::skew(turned);
    result.byLocal.block<2, 3>(2 * i, 3) = byPoint;
  }
  return result;
}

vpTsaiState vpTsaiProblem::plus(const vpTsaiState &state, const Eigen::VectorXd &shared,
                                const std::vector<Eigen::VectorXd> &local) const
{
  vpTsaiState next = state;
  for (std::size_t j = 0; j < m_free.size(); ++j) {
    next.shared[static_cast<std::size_t>(m_free[j])] += shared[static_cast<Eigen::Index>(j)];
  }
  for (std::size_t k = 0; k < local.size(); ++k) {
    next.poses[k].R = vpSO3::exp(local[k].head<3>()) * next.poses[k].R;
    next.poses[k].t += local[k].tail<3>();
  }
  return next;
}

END_VISP_NAMESPACE
