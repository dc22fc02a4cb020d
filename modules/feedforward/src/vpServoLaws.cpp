/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpServoLaws.h"

#include "vpFeedforwardErrors.h"
#include "vpServoCheck.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/feedforward/vpServoMeasurement.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
/*!
 * \brief The mean of the visible points as an image feature, with its exact interaction matrix.
 *
 * The mean of image points is not the image of a point of the object, so the interaction matrix of one point at the
 * mean is only approximate. The mean of the points' interaction matrices is exact, and costs a few sums. Rows: mean x,
 * mean y, mean Z. For a single point these are the textbook rows.
 */
struct vpMeanPoint {
  unsigned int count = 0;         //!< Points visible now and in the goal; if 0, the rest is invalid.
  Eigen::Vector2d xy;             //!< Mean of (x, y) now.
  Eigen::Vector2d goalXy;         //!< Mean of (x, y) of the same points in the goal.
  double Z;                       //!< Mean depth now, m.
  double goalZ;                   //!< Mean depth of the same points in the goal, m.
  Eigen::Matrix<double, 2, 3> Lv; //!< (x, y)' = Lv v + Lw w.
  Eigen::Matrix<double, 2, 3> Lw;
  Eigen::RowVector3d depthLw; //!< Z' = -vz + depthLw w.

  vpMeanPoint(const std::vector<vpServoPoint> &points, const std::vector<vpServoPoint> &goal)
    : xy(0., 0.), goalXy(0., 0.), Z(0.), goalZ(0.), Lv(Eigen::Matrix<double, 2, 3>::Zero()),
      Lw(Eigen::Matrix<double, 2, 3>::Zero()), depthLw(0., 0., 0.)
  {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const vpServoPoint &p = points[i], &g = goal[i];
      if (!p.visible || !g.visible) {
        continue;
      }
      ++count;
      xy += Eigen::Vector2d(p.x, p.y);
      goalXy += Eigen::Vector2d(g.x, g.y);
      Z += p.Z;
      goalZ += g.Z;
      const double inverseZ = 1. / p.Z;
      Lv(0, 0) -= inverseZ;
      Lv(0, 2) += p.x * inverseZ;
      Lv(1, 2) += p.y * inverseZ;
      Lw(0, 0) += p.x * p.y;
      Lw(0, 1) -= 1. + p.x * p.x;
      Lw(1, 0) += 1. + p.y * p.y;
      depthLw.x() -= p.y * p.Z;
      depthLw.y() += p.x * p.Z;
    }
    if (count == 0) {
      return;
    }
    Lv(1, 1) = Lv(0, 0);
    Lw(1, 1) = -Lw(0, 0);
    Lw(0, 2) = xy.y();
    Lw(1, 2) = -xy.x();
    const double share = 1. / count;
    xy *= share;
    goalXy *= share;
    Z *= share;
    goalZ *= share;
    Lv *= share;
    Lw *= share;
    depthLw *= share;
  }
};

// Thesis (5.10): the camera moves on a straight line to its goal.
class vpServoPbvs1 : public vpServoLaw
{
public:
  vpServoPbvs1(const std::string &id, const vpServoGains &gains, double rotationFactor)
    : vpServoLaw(id, gains, rotationFactor)
  {}

protected:
  vpServoCommand compute(const vpServoMeasurement &measurement, double) noexcept VP_OVERRIDE
  {
    const vpServoPose::Error error = vpServoPose::error(m_goal.cdMo, measurement.cMo);
    const Eigen::Vector3d v = -m_gains.lambda * (error.R.transpose() * error.t);
    const Eigen::Vector3d w = -rotationGain() * vpSO3::log(error.R);
    return {vpServoPose::twist(v, w), vpServoStatus::Servoing};
  }
};

// Thesis (5.13), signs corrected: the object's origin moves on a straight line in the camera frame. From
// t_o' = -v - w x t_o and t_o' = -lambda (t_o - t_o*).
class vpServoPbvs2 : public vpServoLaw
{
public:
  vpServoPbvs2(const std::string &id, const vpServoGains &gains, double rotationFactor)
    : vpServoLaw(id, gains, rotationFactor)
  {}

protected:
  vpServoCommand compute(const vpServoMeasurement &measurement, double) noexcept VP_OVERRIDE
  {
    const vpServoPose::Error error = vpServoPose::error(m_goal.cdMo, measurement.cMo);
    const Eigen::Vector3d origin = vpServoPose::translation(measurement.cMo);
    const Eigen::Vector3d w = -rotationGain() * vpSO3::log(error.R);
    const Eigen::Vector3d v = m_gains.lambda * (origin - vpServoPose::translation(m_goal.cdMo)) + origin.cross(w);
    return {vpServoPose::twist(v, w), vpServoStatus::Servoing};
  }
};

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Smallest eigenvalue of L^T L, relative to the largest, that counts as nonzero. A square of 5 mm at 2 m has 7e-12 or
// more; fewer than three points, or collinear points, have 4e-16. The pivots of a Cholesky factor do not separate
// these: there the line has up to 1e-8.
constexpr double smallestEigenvalue = 1e-13;

// A roll by theta retreats to 1 / cos(theta / 2) of the depth: five times at 157 deg, without bound at 180.
constexpr double mostRetreat = 5.;

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
    if (!(mean.Z <= mostRetreat * m_depth)) {
      return {vpTwist(), vpServoStatus::Diverging};
    }
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    for (std::size_t i = 0; i < measurement.points.size(); ++i) {
      const vpServoPoint &p = measurement.points[i], &g = m_goal.points[i];
      if (!p.visible || !g.visible) {
        continue;
      }
      const Eigen::Matrix<double, 2, 6> L = vpPointInteraction(p);
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

// 2-1/2 D, thesis (5.20)-(5.21): rotation from the pose; mean image point and log depth control the translation, with
// the motion caused by the rotation compensated, so that the mean point moves on a straight line in the image. The
// depth ratio is that of the measured depths; det(H) of (5.21) is the ratio of the distances to a plane instead.
class vpServoHybrid25d : public vpServoLaw
{
public:
  vpServoHybrid25d(const std::string &id, const vpServoGains &gains, double rotationFactor)
    : vpServoLaw(id, gains, rotationFactor)
  {}

protected:
  vpServoCommand compute(const vpServoMeasurement &measurement, double) noexcept VP_OVERRIDE
  {
    const vpMeanPoint mean(measurement.points, m_goal.points);
    if (mean.count == 0) {
      return {vpTwist(), vpServoStatus::Degenerate};
    }
    const vpServoPose::Error error = vpServoPose::error(m_goal.cdMo, measurement.cMo);
    const Eigen::Vector3d w = -rotationGain() * vpSO3::log(error.R);
    // log(Z / Z*)' = (-vz + depthLw w) / Z, then the two image rows: upper triangular, never singular.
    Eigen::Vector3d v;
    v.z() = m_gains.lambda * mean.Z * std::log(mean.Z / mean.goalZ) + mean.depthLw * w;
    const Eigen::Vector2d rest = -m_gains.lambda * (mean.xy - mean.goalXy) - mean.Lw * w - mean.Lv.col(2) * v.z();
    v.head<2>() = rest / mean.Lv(0, 0);
    return {vpServoPose::twist(v, w), vpServoStatus::Servoing};
  }
};

// Determinant below which the required rotation is no longer sensible; it is 1 + x^2 + y^2 near the goal.
constexpr double smallestDeterminant = 1e-2;

/*
 * Kyrki et al., thesis (5.22) corrected: e = (t, x - x*, y - y*, theta u_z). The translation is that of pbvs1; pan and
 * tilt hold the mean point, roll comes from the pose. In the full law the image motion caused by the translation is
 * compensated, so the image error decays independently; the decoupled law, used for comparison in the thesis, does not.
 *
 * The last row is row 3 of L_theta_u, so the determinant is (1 + x^2 + y^2) (row 3 . (x, y, 1)), which vanishes for
 * large rotations about the other axes: the law returns Degenerate there.
 */
class vpServoKyrki : public vpServoLaw
{
public:
  vpServoKyrki(const std::string &id, const vpServoGains &gains, double rotationFactor, bool decoupled)
    : vpServoLaw(id, gains, rotationFactor), m_decoupled(decoupled)
  {}

protected:
  vpServoCommand compute(const vpServoMeasurement &measurement, double) noexcept VP_OVERRIDE
  {
    const vpMeanPoint mean(measurement.points, m_goal.points);
    if (mean.count == 0) {
      return {vpTwist(), vpServoStatus::Degenerate};
    }
    const vpServoPose::Error error = vpServoPose::error(m_goal.cdMo, measurement.cMo);
    const Eigen::Vector3d thetaU = vpSO3::log(error.R);
    const Eigen::Vector3d v = -m_gains.lambda * (error.R.transpose() * error.t);

    Eigen::Matrix3d L;
    L << mean.Lw, vpSO3::rightJacobianInverse(thetaU).row(2);
    Eigen::Vector3d rate;
    rate << -rotationGain() * (mean.xy - mean.goalXy), -rotationGain() * thetaU.z();
    if (!m_decoupled) {
      rate.head<2>() -= mean.Lv * v;
    }
    Eigen::Matrix3d inverse;
    double determinant;
    bool invertible;
    L.computeInverseAndDetWithCheck(inverse, determinant, invertible, smallestDeterminant);
    if (!invertible) {
      return {vpTwist(), vpServoStatus::Degenerate};
    }
    return {vpServoPose::twist(v, inverse * rate), vpServoStatus::Servoing};
  }

private:
  bool m_decoupled;
};

// The FF-PBVS law of thesis 5.3, corrected: (5.26) and (5.28) swap the image axes and lack a sign. pbvs1 whose
// rotation error also contains the bearing error of the object relative to its desired image position.
class vpServoFeedforwardSum : public vpServoLaw
{
public:
  vpServoFeedforwardSum(const std::string &id, const vpServoGains &gains, double rotationFactor)
    : vpServoLaw(id, gains, rotationFactor)
  {}

protected:
  vpServoCommand compute(const vpServoMeasurement &measurement, double) noexcept VP_OVERRIDE
  {
    const vpServoPose::Error error = vpServoPose::error(m_goal.cdMo, measurement.cMo);
    const vpFeedforwardSum sum(error.R, measurement.points, m_goal.points, m_gains);
    if (!sum.defined) {
      return {vpTwist(), vpServoStatus::Degenerate};
    }
    const Eigen::Vector3d v = -m_gains.lambda * (error.R.transpose() * error.t);
    return {vpServoPose::twist(v, -rotationGain() * sum.e), vpServoStatus::Servoing};
  }
};
} // namespace

std::unique_ptr<vpServoLaw> vpServoLaws::makePbvs1(const std::string &id, const vpServoGains &gains,
                                                   double rotationFactor)
{
  return std::make_unique<vpServoPbvs1>(id, gains, rotationFactor);
}

std::unique_ptr<vpServoLaw> vpServoLaws::makePbvs2(const std::string &id, const vpServoGains &gains,
                                                   double rotationFactor)
{
  return std::make_unique<vpServoPbvs2>(id, gains, rotationFactor);
}

std::unique_ptr<vpServoLaw> vpServoLaws::makeIbvs(const std::string &id, const vpServoGains &gains,
                                                  double rotationFactor)
{
  return std::make_unique<vpServoIbvs>(id, gains, rotationFactor);
}

std::unique_ptr<vpServoLaw> vpServoLaws::makeHybrid25d(const std::string &id, const vpServoGains &gains,
                                                       double rotationFactor)
{
  return std::make_unique<vpServoHybrid25d>(id, gains, rotationFactor);
}

std::unique_ptr<vpServoLaw> vpServoLaws::makeKyrki(const std::string &id, const vpServoGains &gains,
                                                   double rotationFactor)
{
  return std::make_unique<vpServoKyrki>(id, gains, rotationFactor, false);
}

std::unique_ptr<vpServoLaw> vpServoLaws::makeKyrkiDecoupled(const std::string &id, const vpServoGains &gains,
                                                            double rotationFactor)
{
  return std::make_unique<vpServoKyrki>(id, gains, rotationFactor, true);
}

std::unique_ptr<vpServoLaw> vpServoLaws::makeFeedforwardSum(const std::string &id, const vpServoGains &gains,
                                                            double rotationFactor)
{
  return std::make_unique<vpServoFeedforwardSum>(id, gains, rotationFactor);
}

END_VISP_NAMESPACE
