/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMeanPoint.h"
#include "vpServoLaws.h"
#include "vpServoPose.h"

#include <visp3/direct_core/vpSO3.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
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
} // namespace

std::unique_ptr<vpServoLaw> vpServoLaws::makeHybrid25d(const std::string &id, const vpServoGains &gains,
                                                       double rotationFactor)
{
  return std::make_unique<vpServoHybrid25d>(id, gains, rotationFactor);
}

END_VISP_NAMESPACE
