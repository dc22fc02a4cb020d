/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpFeatureFeedforwardSum.h>

#include "vpBearing.h"
#include "vpFeatureRows.h"
#include "vpServoCheck.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

vpFeatureFeedforwardSum::vpFeatureFeedforwardSum(double kappa, double saturation)
  : m_kappa(kappa), m_saturation(saturation)
{
  if (!(std::isfinite(kappa) && kappa >= 0.)) {
    throw vpException(vpException::badValue, "kappa of the feedforward-sum feature is %g, must be finite and >= 0",
                      kappa);
  }
  if (!(std::isfinite(saturation) && saturation > 0.)) {
    throw vpException(vpException::badValue,
                      "saturation of the feedforward-sum feature is %g rad, must be finite and > 0", saturation);
  }
  dim_s = 3;
  init();
}

void vpFeatureFeedforwardSum::init()
{
  s.resize(dim_s);
  m_interaction << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
}

void vpFeatureFeedforwardSum::buildFrom(const vpHomogeneousMatrix &cdMc, const vpServoPoint &point,
                                        const vpServoPoint &goal)
{
  const Eigen::Vector2d p(point.x, point.y), pGoal(goal.x, goal.y);
  if (!vpServoCheck::isPoint(point) || !vpServoCheck::isPoint({goal.x, goal.y, 1., true}) ||
      !vpServoCheck::isPose(cdMc)) {
    throw vpException(
        vpException::badValue,
        "point of the feedforward-sum feature is x = %g, y = %g, Z = %g m, must be finite with Z > 0, and cdMc a pose",
        point.x, point.y, point.Z);
  }
  const Eigen::Vector3d thetaU = vpSO3::log(vpServoPose::rotation(cdMc));
  const Eigen::Vector3d D = vpBearing::angle(p) - vpBearing::angle(pGoal);
  const Eigen::Vector3d e = thetaU - m_kappa * vpBearing::saturate(D, m_saturation);
  for (unsigned int i = 0; i < 3; ++i) {
    s[i] = e[i];
  }
  const double inverseZ = 1. / point.Z;
  Eigen::Matrix<double, 2, 6> L;
  L << -inverseZ, 0., p.x() * inverseZ, p.x() * p.y(), -1. - p.x() * p.x(), p.y(), //
      0., -inverseZ, p.y() * inverseZ, 1. + p.y() * p.y(), -p.x() * p.y(), -p.x();
  m_interaction << Eigen::Matrix3d::Zero(), vpSO3::rightJacobianInverse(thetaU);
  m_interaction -= m_kappa * vpBearing::saturateSlope(D, m_saturation).asDiagonal() * vpBearing::jacobian(p) * L;
}

vpMatrix vpFeatureFeedforwardSum::interaction(unsigned int select)
{
  return vpFeatureRows::select(m_interaction, select);
}

void vpFeatureFeedforwardSum::print(unsigned int select) const { vpFeatureRows::print("feedforward-sum", s, select); }

vpFeatureFeedforwardSum *vpFeatureFeedforwardSum::duplicate() const { return new vpFeatureFeedforwardSum(*this); }

END_VISP_NAMESPACE
