/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpSO3.h>
#include <visp3/direct_core/vpTwist.h>

#include <visp3/core/vpException.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace vpSO3
{
namespace
{
// Below this squared angle the Taylor series is exact to rounding while the closed forms lose digits.
constexpr double smallAngle2 = 1e-4;

double sinOverAngle(double a2)
{
  if (a2 < smallAngle2) {
    return 1. - a2 / 6. * (1. - a2 / 20. * (1. - a2 / 42.));
  }
  const double a = std::sqrt(a2);
  return std::sin(a) / a;
}

double oneMinusCosOverAngle2(double a2)
{
  if (a2 < smallAngle2) {
    return 0.5 - a2 / 24. * (1. - a2 / 30. * (1. - a2 / 56.));
  }
  const double s = std::sin(0.5 * std::sqrt(a2));
  return 2. * s * s / a2;
}

double angleMinusSinOverAngle3(double a2)
{
  if (a2 < smallAngle2) {
    return 1. / 6. - a2 / 120. * (1. - a2 / 42. * (1. - a2 / 72.));
  }
  const double a = std::sqrt(a2);
  return (a - std::sin(a)) / (a2 * a);
}

// Unit vector along a of any length; NaN for a zero or non-finite vector.
Eigen::Vector3d unit(const Eigen::Vector3d &a)
{
  const Eigen::Vector3d scaled = a / a.cwiseAbs().maxCoeff(); // so that squares neither overflow nor underflow
  return scaled / scaled.norm();
}

// Minimal rotation between unit vectors at most 90 deg apart.
Eigen::Matrix3d acuteRotation(const Eigen::Vector3d &a, const Eigen::Vector3d &b, double cosine)
{
  const Eigen::Matrix3d k = skew(a.cross(b));
  return Eigen::Matrix3d::Identity() + k + k * k / (1. + cosine);
}
} // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d &a)
{
  Eigen::Matrix3d m;
  m << 0., -a.z(), a.y(), a.z(), 0., -a.x(), -a.y(), a.x(), 0.;
  return m;
}

Eigen::Matrix3d exp(const Eigen::Vector3d &e)
{
  const double a2 = e.squaredNorm();
  const Eigen::Matrix3d k = skew(e);
  return Eigen::Matrix3d::Identity() + sinOverAngle(a2) * k + oneMinusCosOverAngle2(a2) * k * k;
}

Eigen::Vector3d log(const Eigen::Matrix3d &R)
{
  // Via the quaternion: well conditioned at every angle, no branch on the trace needed beyond Eigen's own.
  Eigen::Quaterniond q(R);
  if (q.w() < 0.) {
    q.coeffs() = -q.coeffs();
  }
  const double s = q.vec().norm(); // sin(theta / 2)
  const double ratio = s < 1e-9 ? 2. / q.w() : 2. * std::atan2(s, q.w()) / s;
  return ratio * q.vec();
}

Eigen::Matrix3d rightJacobian(const Eigen::Vector3d &e)
{
  const double a2 = e.squaredNorm();
  const Eigen::Matrix3d k = skew(e);
  return Eigen::Matrix3d::Identity() - oneMinusCosOverAngle2(a2) * k + angleMinusSinOverAngle3(a2) * k * k;
}

Eigen::Matrix3d rightJacobianInverse(const Eigen::Vector3d &e)
{
  const double a2 = e.squaredNorm();
  const Eigen::Matrix3d k = skew(e);
  double c;
  if (a2 < smallAngle2) {
    c = 1. / 12. + a2 / 720. * (1. + a2 / 42.);
  }
  else {
    const double half = 0.5 * std::sqrt(a2);
    c = (1. - half / std::tan(half)) / a2;
  }
  return Eigen::Matrix3d::Identity() + 0.5 * k + c * k * k;
}

Eigen::Matrix3d minimalRotation(const Eigen::Vector3d &from, const Eigen::Vector3d &to)
{
  const Eigen::Vector3d a = unit(from), b = unit(to);
  const double cosine = a.dot(b);
  if (!(cosine < 0.)) {
    return acuteRotation(a, b, cosine);
  }
  // The quotient above loses digits near opposite directions. So first a half turn to -a, about an axis exactly
  // perpendicular to a, then the acute rotation from there. a + b is exact where it is small, hence so is the axis.
  Eigen::Vector3d axis = unit(a.cross(a + b));
  axis -= a.dot(axis) * a;
  if (!(axis.squaredNorm() > 0.5)) { // opposite to within rounding
    axis = a.unitOrthogonal();
  }
  axis.normalize();
  const Eigen::Matrix3d halfTurn = 2. * axis * axis.transpose() - Eigen::Matrix3d::Identity();
  return acuteRotation(-a, b, -cosine) * halfTurn;
}
} // namespace vpSO3

namespace
{
// Squares overflow from 1e154 on. (std::hypot of three numbers loses a NaN among zeros.)
double norm(double x, double y, double z) { return std::hypot(std::hypot(x, y), z); }
} // namespace

vpTwist vpTwist::fromColVector(const vpColVector &v)
{
  if (v.getRows() != 6) {
    throw vpException(vpException::dimensionError, "a twist has 6 components, got a vector of %u", v.getRows());
  }
  return {v[0], v[1], v[2], v[3], v[4], v[5]};
}

vpColVector vpTwist::toColVector() const
{
  vpColVector v;
  copyTo(v);
  return v;
}

void vpTwist::copyTo(vpColVector &v) const
{
  v.resize(6, false);
  for (unsigned int i = 0; i < 6; ++i) {
    v[i] = m_data[i];
  }
}

double vpTwist::linearNorm() const { return norm(m_data[0], m_data[1], m_data[2]); }

double vpTwist::angularNorm() const { return norm(m_data[3], m_data[4], m_data[5]); }

bool vpTwist::isFinite() const
{
  for (double x : m_data) {
    if (!std::isfinite(x)) {
      return false;
    }
  }
  return true;
}

vpTwist vpTwist::scaled(double factor) const
{
  vpTwist out = *this;
  for (double &x : out.m_data) {
    x *= factor;
  }
  return out;
}

vpTwist vpLimitTwist(const vpTwist &twist, double maxLinear, double maxAngular)
{
  if (!twist.isFinite() || !(maxLinear > 0.) || !(maxAngular > 0.)) {
    return {};
  }
  double excess = 1.;
  for (const auto &[length, limit] : {std::pair(twist.linearNorm(), maxLinear), {twist.angularNorm(), maxAngular}}) {
    if (length > limit) { // both may be infinite, and their quotient NaN
      excess = std::max(excess, length / limit);
    }
  }
  return excess > 1. ? twist.scaled(1. / excess) : twist;
}

END_VISP_NAMESPACE
