/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"

#include <visp3/feedforward/vpViewConstraintFilter.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the view constraint");
// Less than this share of the desired speed left: deadlock.
constexpr double deadlockShare = 0.02;
// Desired speeds below this, in units of the limits, count as standing still, not deadlock.
constexpr double standstill = 1e-6;
// Maximum camera motion in one period, in depths of the nearest point and, times rho1, in rad.
constexpr double mostPerPeriod = 0.125;
// Smallest factor of the scaling to the desired speed for which the margin is derived.
constexpr double smallestScale = 0.5;

double speed(const vpTwist &twist, double maxLinear, double maxAngular)
{
  return std::max(twist.linearNorm() / maxLinear, twist.angularNorm() / maxAngular);
}
} // namespace

vpViewConstraintSpec vpViewConstraintSpec::fromCamera(const vpCameraParameters &camera, unsigned int width,
                                                      unsigned int height)
{
  if (width == 0 || height == 0) {
    throw vpException(vpException::badValue, "the view constraint's image is %u x %u px, must not be empty", width,
                      height);
  }
  vpViewConstraintSpec spec;
  spec.left = -camera.get_u0() / camera.get_px();
  spec.right = (width - 1. - camera.get_u0()) / camera.get_px();
  spec.top = -camera.get_v0() / camera.get_py();
  spec.bottom = (height - 1. - camera.get_v0()) / camera.get_py();
  spec.validate();
  return spec;
}

void vpViewConstraintSpec::validate() const
{
  fields.require(std::isfinite(left) && left < 0., "left border", left, "finite and < 0");
  fields.positive("right border", right);
  fields.require(std::isfinite(top) && top < 0., "top border", top, "finite and < 0");
  fields.positive("bottom border", bottom);
  fields.positive("period", period, "s");
  fields.require(gamma > 0. && gamma * period <= 0.5, "gamma", gamma, "> 0 and at most 0.5 / period 1/s");
  fields.require(imageUncertainty >= 0. && imageUncertainty < std::min({-left, right, -top, bottom}),
                 "imageUncertainty", imageUncertainty,
                 ">= 0 and less than the distance from the principal point to each border");
  fields.in("depthUncertainty", depthUncertainty, {0., 0.9});
  fields.positive("maxLinear", maxLinear, "m/s");
  fields.positive("maxAngular", maxAngular, "rad/s");
}

vpViewConstraintFilter::vpViewConstraintFilter(const vpViewConstraintSpec &spec) : m_spec(spec), m_inside(true)
{
  spec.validate();
  m_radius = std::hypot(std::max(-spec.left, spec.right), std::max(-spec.top, spec.bottom));
}

vpViewConstraintFilter::Bounds vpViewConstraintFilter::bounds(double Z, const Speeds &speeds,
                                                              double period) const noexcept
{
  // The names of the proof in the header.
  const double T = period, V = speeds.linear, W = speeds.angular, u = m_spec.imageUncertainty;
  const double nearest = Z * (1. - m_spec.depthUncertainty);
  const double zeta = (nearest - V * T) * std::exp(-W * m_radius * T);
  const double rho1 = std::hypot(1., m_radius);
  const double C = rho1 * W * (V / zeta + W * rho1);
  const double kappa = V / zeta + W * m_radius;
  const double D = u * (V / nearest + W * (1. + 3. * m_radius + 2. * u));
  const double gamma = std::min(m_spec.gamma, 0.5 * std::exp(-2. * kappa * T) / T);
  return {gamma, std::exp(4. * kappa * T) * (C * T + 2. * D) / gamma};
}

double vpViewConstraintFilter::margin(double Z, double linear, double angular, double period) const noexcept
{
  return bounds(Z, {linear, angular}, period).margin;
}

bool vpViewConstraintFilter::addRows(const vpServoPoint &point, const Speeds &limits, double share,
                                     double period) noexcept
{
  const Bounds bound = bounds(point.Z, {share * limits.linear, share * limits.angular}, period);
  const double inset = bound.margin + m_spec.imageUncertainty;
  const double x = point.x, y = point.y;
  const double distance[4] = {x - m_spec.left, m_spec.right - x, y - m_spec.top, m_spec.bottom - y};
  for (double b : distance) {
    m_inside = m_inside && b >= m_spec.imageUncertainty;
  }
  const int ends = m_spec.depthUncertainty > 0. ? 2 : 1;
  for (int end = 0; end < ends; ++end) {
    const double inverseZ = 1. / (point.Z * (1. + (end == 0 ? -1. : 1.) * m_spec.depthUncertainty));
    Eigen::Matrix<double, 2, 6> L;
    L << -inverseZ, 0., x * inverseZ, x * y, -1. - x * x, y, //
        0., -inverseZ, y * inverseZ, 1. + y * y, -x * y, -x;
    L.leftCols<3>() *= limits.linear;
    L.rightCols<3>() *= limits.angular;
    for (int border = 0; border < 4; ++border) {
      const double inwards = border % 2 == 0 ? 1. : -1.;
      if (!m_projection.addRow(inwards * L.row(border / 2).transpose(), -bound.gamma * (distance[border] - inset))) {
        return false;
      }
    }
  }
  return true;
}

vpServoCommand vpViewConstraintFilter::filter(const vpServoCommand &wanted, const std::vector<vpServoPoint> &outline,
                                              double dt) noexcept
{
  if (wanted.status != vpServoStatus::Servoing) {
    return wanted;
  }
  const vpServoCommand invalid{vpTwist(), vpServoStatus::InvalidInput};
  if (!wanted.v.isFinite() || !(std::isfinite(dt) && dt > 0.)) {
    return invalid;
  }
  int visible = 0;
  const double period = std::max(dt, m_spec.period);
  Speeds limits{m_spec.maxLinear, m_spec.maxAngular};
  for (const vpServoPoint &point : outline) {
    if (!point.visible) {
      continue;
    }
    ++visible;
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.Z) || !(point.Z > 0.)) {
      return invalid;
    }
    // The margin requires a camera that neither approaches the point nor rotates far within one period.
    limits.linear = std::min(limits.linear, mostPerPeriod * point.Z * (1. - m_spec.depthUncertainty) / period);
    limits.angular = std::min(limits.angular, mostPerPeriod / (std::hypot(1., m_radius) * period));
  }
  if (visible > maxPoints) {
    return invalid;
  }

  const vpTwist start = vpLimitTwist(wanted.v, limits.linear, limits.angular);
  const double startSpeed = speed(start, limits.linear, limits.angular);
  m_projection.clear();
  m_inside = true;
  for (const vpServoPoint &point : outline) {
    if (point.visible && !addRows(point, limits, startSpeed, period)) {
      return invalid;
    }
  }

  vpTwistProjection::Vector x;
  for (int i = 0; i < 6; ++i) {
    x[i] = start[i] / (i < 3 ? limits.linear : limits.angular);
  }
  vpServoCommand command{vpTwist(), vpServoStatus::Deadlock};
  if (m_projection.solve(x) == vpTwistProjection::Result::Solved) {
    x = m_projection.solution();
    const double solvedSpeed = std::max(x.head<3>().norm(), x.tail<3>().norm());
    const double scale = solvedSpeed > startSpeed ? startSpeed / solvedSpeed : 1.;
    // Points outside the image have to return at any speed; there is no guarantee for the border there.
    if (scale >= smallestScale || !m_inside) {
      for (int i = 0; i < 6; ++i) {
        command.v[i] = scale * x[i] * (i < 3 ? limits.linear : limits.angular);
      }
    }
  }
  if (!command.v.isFinite()) {
    return invalid;
  }
  if (startSpeed <= standstill || speed(command.v, limits.linear, limits.angular) > deadlockShare * startSpeed) {
    double change = 0.;
    for (int i = 0; i < 6; ++i) {
      change = std::max(change, std::abs(command.v[i] - wanted.v[i]));
    }
    command.status = change > 1e-9 ? vpServoStatus::ViewLimited : vpServoStatus::Servoing;
  }
  return command;
}

END_VISP_NAMESPACE
