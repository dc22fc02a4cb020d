/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMeanPoint.h"
#include "vpServoLaws.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Smallest eigenvalue of L^T L, relative to the largest, that counts as nonzero. A square of 5 mm at 2 m has 7e-12 or
// more; fewer than three points, or collinear points, have 4e-16. The pivots of a Cholesky factor do not separate
// these: there the line has up to 1e-8.
constexpr double smallestEigenvalue = 1e-13;

// A roll by theta retreats to 1 / cos(theta / 2) of the depth: five times at 157 deg, without bound at 180.
constexpr double farthest = 5.;

// Thesis (5.4) with the points' interaction matrix at the current image and depth, in normalised coordinates and with
// the sign of (5.21): v = -lambda L^+ e. The pseudo-inverse of any number of points is solved as 6x6 normal equations.
class vpServoIbvs : public vpServoLaw
{
public:
  vpServoIbvs(const std::string &id, const vpServoGains &gains, double rotationFactor)
    : vpServoLaw(id, gains, rotationFactor)
  {}
  double rotationGain() const noexcept VP_OVERRIDE { return m_gains.lambda; } // one gain for the whole image error

protected:
  vpServoCommand compute(const vpServoMeasurement &measurement, double) noexcept VP_OVERRIDE
  {
    const vpMeanPoint mean(measurement.points, m_goal.points);
    if (mean.count == 0) {
      return {vpTwist(), vpServoStatus::Degenerate};
    }
    m_depth = m_depth > 0. ? m_depth : std::max(mean.Z, mean.goalZ);
    if (!(mean.Z <= farthest * m_depth)) {
      return {vpTwist(), vpServoStatus::Diverging};
    }
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    for (std::size_t i = 0; i < measurement.points.size(); ++i) {
      const vpServoPoint &p = measurement.points[i], &g = m_goal.points[i];
      if (!p.visible || !g.visible) {
        continue;
      }
      const double inverseZ = 1. / p.Z;
      Eigen::Matrix<double, 2, 6> L;
      L << -inverseZ, 0., p.x * inverseZ, p.x * p.y, -1. - p.x * p.x, p.y, //
          0., -inverseZ, p.y * inverseZ, 1. + p.y * p.y, -p.x * p.y, -p.x;
      normal.noalias() += L.transpose() * L;
      right.noalias() += L.transpose() * Eigen::Vector2d(p.x - g.x, p.y - g.y);
    }
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(normal);
    const Vector6 &values = solver.eigenvalues();
    if (solver.info() != Eigen::Success || !(values[0] > smallestEigenvalue * values[5])) {
      return {vpTwist(), vpServoStatus::Degenerate};
    }
    const Vector6 modes = (solver.eigenvectors().transpose() * right).cwiseQuotient(values);
    const Vector6 v = -m_gains.lambda * (solver.eigenvectors() * modes);
    return {vpTwist(v[0], v[1], v[2], v[3], v[4], v[5]), vpServoStatus::Servoing};
  }

  void goalChanged() VP_OVERRIDE { m_depth = 0.; }

private:
  double m_depth = 0.; // larger of the depths at the goal and at the first measurement for it, m; 0: not seen yet
};
} // namespace

std::unique_ptr<vpServoLaw> vpServoLaws::makeIbvs(const std::string &id, const vpServoGains &gains,
                                                  double rotationFactor)
{
  return std::make_unique<vpServoIbvs>(id, gains, rotationFactor);
}

END_VISP_NAMESPACE
