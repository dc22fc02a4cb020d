/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpReachPoint.h"

#include <Eigen/Dense>

BEGIN_VISP_NAMESPACE

bool vpReachPoint(const vpArmModel &model, const Eigen::Vector3d &place, vpJointVector &q)
{
  constexpr int steps = 200;
  constexpr double longest = 0.05, close = 1e-9; // m
  vpArmData data;
  for (int i = 0; i < steps; ++i) {
    vpArmKinematics::update(model, q, data);
    Eigen::Vector3d error = place - data.tool.p;
    if (error.norm() < close) {
      return true;
    }
    const double damping = 1e-6 + 1e-3 * error.squaredNorm(); // vanishes at the end
    error *= std::min(1., longest / error.norm());
    const auto J = data.J.topRows<3>();
    const Eigen::Matrix3d JJ = J * J.transpose() + damping * Eigen::Matrix3d::Identity();
    q += J.transpose() * JJ.ldlt().solve(error);
    q = q.cwiseMax(model.lower()).cwiseMin(model.upper()).eval();
  }
  return false;
}

END_VISP_NAMESPACE
