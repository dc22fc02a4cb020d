/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpFeatureFeedforwardSum.h>
#include <visp3/feedforward/vpFeatureLookAt.h>
#include <visp3/feedforward/vpFeedforwardStability.h>

#include "vpFeedforwardErrors.h"
#include "vpFieldCheck.h"
#include "vpServoCheck.h"
#include "vpServoLaws.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMatrix.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/visual_features/vpBasicFeature.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
namespace vpFeatureRows
{
//! The rows of \e L selected by \e select.
inline vpMatrix select(const Eigen::Matrix<double, 3, 6> &L, unsigned int select)
{
  vpMatrix rows;
  for (unsigned int i = 0; i < 3; ++i) {
    if (vpBasicFeature::FEATURE_LINE[i] & select) {
      const unsigned int n = rows.getRows();
      rows.resize(n + 1, 6, false);
      for (unsigned int k = 0; k < 6; ++k) {
        rows[n][k] = L(i, k);
      }
    }
  }
  return rows;
}

//! "name: s0 s1 s2" with the selected components.
inline void print(const char *name, const vpColVector &s, unsigned int select)
{
  std::cout << name << ":";
  for (unsigned int i = 0; i < s.getRows(); ++i) {
    if (vpBasicFeature::FEATURE_LINE[i] & select) {
      std::cout << ' ' << s[i];
    }
  }
  std::cout << std::endl;
}

//! \throw vpException (badValue) naming the first visible point that is not valid.
inline void requirePoints(const char *owner, const std::vector<vpServoPoint> &points)
{
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].visible) {
      vpServoCheck::requirePoint(owner, i, points[i]);
    }
  }
}
} // namespace vpFeatureRows
} // namespace

vpFeatureFeedforwardSum::vpFeatureFeedforwardSum(const vpServoGains &gains) : m_gains(gains)
{
  m_gains.validate();
  dim_s = 3;
  init();
}

void vpFeatureFeedforwardSum::init() { s.resize(dim_s); }

void vpFeatureFeedforwardSum::buildFrom(const vpHomogeneousMatrix &cdMc, const std::vector<vpServoPoint> &points,
                                        const std::vector<vpServoPoint> &goal)
{
  if (points.size() != goal.size()) {
    throw vpException(vpException::badValue, "the feedforward-sum feature has %u points, its goal %u",
                      static_cast<unsigned int>(points.size()), static_cast<unsigned int>(goal.size()));
  }
  vpFeatureRows::requirePoints("the feedforward-sum feature", points);
  vpFeatureRows::requirePoints("the feedforward-sum feature's goal", goal);
  if (!vpServoCheck::isPose(cdMc)) {
    throw vpException(
        vpException::badValue,
        "cdMc of the feedforward-sum feature is not a finite rigid motion, its translation is (%g, %g, %g) m",
        cdMc[0][3], cdMc[1][3], cdMc[2][3]);
  }
  const vpFeedforwardSum sum(vpServoPose::rotation(cdMc), points, goal, m_gains);
  if (!sum.defined) {
    throw vpException(vpException::badValue,
                      "the feedforward-sum feature has no point that is visible now and in the goal, of %u",
                      static_cast<unsigned int>(points.size()));
  }
  for (unsigned int i = 0; i < 3; ++i) {
    s[i] = m_gains.rotation * sum.e[i];
  }
}

vpMatrix vpFeatureFeedforwardSum::interaction(unsigned int select)
{
  Eigen::Matrix<double, 3, 6> task;
  task << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
  return vpFeatureRows::select(task, select);
}

void vpFeatureFeedforwardSum::print(unsigned int select) const { vpFeatureRows::print("feedforward-sum", s, select); }

vpFeatureFeedforwardSum *vpFeatureFeedforwardSum::duplicate() const { return new vpFeatureFeedforwardSum(*this); }

vpFeatureLookAt::vpFeatureLookAt(const vpServoGains &gains) : m_factor(vpServoLaws::lookAtFactor * gains.rotation)
{
  gains.validate();
  dim_s = 3;
  init();
}

void vpFeatureLookAt::init()
{
  s.resize(dim_s);
  m_interaction << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
}

void vpFeatureLookAt::buildFrom(const vpHomogeneousMatrix &cdMc, const vpHomogeneousMatrix &cdMo)
{
  const Eigen::Matrix3d R = vpServoPose::rotation(cdMc);
  const Eigen::Vector3d t = vpServoPose::translation(cdMc), origin = vpServoPose::translation(cdMo);
  const vpLookAt lookAt(origin, t);
  if (!lookAt.defined || !vpServoCheck::isPose(cdMc) || !vpServoCheck::isPose(cdMo)) {
    throw vpException(vpException::badValue,
                      "look-at feature is undefined: camera at (%g, %g, %g) m, object at (%g, %g, %g) m", t.x(), t.y(),
                      t.z(), origin.x(), origin.y(), origin.z());
  }
  const Eigen::Vector3d e = vpSO3::log(lookAt.rotation.transpose() * R);
  for (unsigned int i = 0; i < 3; ++i) {
    s[i] = m_factor * e[i];
  }
  // d' = -R v: the direction to the object rotates against the camera's motion.
  const Eigen::Matrix3d inverseJacobian = vpSO3::rightJacobianInverse(e);
  m_interaction << inverseJacobian * R.transpose() * lookAt.rate * R, inverseJacobian;
}

vpMatrix vpFeatureLookAt::interaction(unsigned int select) { return vpFeatureRows::select(m_interaction, select); }

void vpFeatureLookAt::print(unsigned int select) const { vpFeatureRows::print("look-at", s, select); }

vpFeatureLookAt *vpFeatureLookAt::duplicate() const { return new vpFeatureLookAt(*this); }

namespace
{
constexpr vpFieldCheck fields("the stability margin");
constexpr unsigned int bearingDirections = 16;

// Points of an equal-area spiral from pole to pole: even coverage of the sphere for any number of points.
Eigen::Vector3d sphereSample(unsigned int i, unsigned int count)
{
  const double z = 1. - (2. * i + 1.) / count;
  const double azimuth = M_PI * (3. - std::sqrt(5.)) * i;
  const double r = std::sqrt(1. - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}
} // namespace

double vpFeedforwardSumStabilityMargin(double bearing, double rotation, double kappa, unsigned int samples)
{
  fields.require(bearing >= 0. && bearing < M_PI / 2., "bearing", bearing, "in [0, pi/2) rad");
  fields.require(rotation >= 0. && rotation <= M_PI, "rotation", rotation, "in [0, pi] rad");
  fields.require(kappa >= 0. && kappa <= 1e6, "kappa", kappa, "finite and >= 0, at most 1e6");
  fields.in("samples", samples, {1});

  double least = std::numeric_limits<double>::infinity();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  for (unsigned int k = 0; k < bearingDirections; ++k) {
    const double azimuth = 2. * M_PI * k / bearingDirections;
    const Eigen::Vector2d p = std::tan(bearing) * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
    Eigen::Matrix<double, 2, 3> Lw;
    Lw << p.x() * p.y(), -1. - p.x() * p.x(), p.y(), 1. + p.y() * p.y(), -p.x() * p.y(), -p.x();
    const Eigen::Matrix3d M = -vpBearing::jacobian(p) * Lw;
    for (unsigned int i = 0; i < samples; ++i) {
      const Eigen::Matrix3d L = vpSO3::rightJacobianInverse(rotation * sphereSample(i, samples));
      for (int corner = 0; corner < 4; ++corner) {
        const Eigen::Vector3d S(corner & 1, corner >> 1, 0.);
        const Eigen::Matrix3d A = L + kappa * S.asDiagonal() * M;
        solver.computeDirect(0.5 * (A + A.transpose()), Eigen::EigenvaluesOnly);
        if (!(solver.eigenvalues()[0] >= least)) { // NaN is not a margin
          least = solver.eigenvalues()[0];
        }
      }
    }
  }
  return least;
}

END_VISP_NAMESPACE
