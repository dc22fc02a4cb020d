/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpFeedforwardStability.h>

#include "vpFieldCheck.h"
#include "vpBearing.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

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
  fields.require(samples >= 1, "samples", samples, ">= 1");

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
