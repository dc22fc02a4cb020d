/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMeanPoint.h"
#include "vpServoLaws.h"
#include "vpServoPose.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/LU>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Determinant below which the required rotation is no longer sensible; it is 1 + x^2 + y^2 near the goal.
constexpr double smallestDeterminant = 1e-2;

/*
 * Kyrki et al., thesis (5.22) corrected: e = (t, x - x*, y - y*, theta u_z). The translation is that of PBVS-1; pan and
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
} // namespace

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

END_VISP_NAMESPACE
