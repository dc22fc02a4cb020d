/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpBearing.h"
#include "vpMeanPoint.h"
#include "vpServoLaws.h"
#include "vpServoPose.h"

#include <visp3/direct_core/vpSO3.h>

BEGIN_VISP_NAMESPACE

namespace
{
// The FF-PBVS law of thesis 5.3, corrected: (5.26) and (5.28) swap the image axes and lack a sign. PBVS-1 whose
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
    const vpMeanPoint mean(measurement.points, m_goal.points);
    if (mean.count == 0) {
      return {vpTwist(), vpServoStatus::Degenerate};
    }
    const vpServoPose::Error error = vpServoPose::error(m_goal.cdMo, measurement.cMo);
    const Eigen::Vector3d D = vpBearing::angle(mean.xy) - vpBearing::angle(mean.goalXy);
    const Eigen::Vector3d rotationError =
        vpSO3::log(error.R) - m_gains.kappa * vpBearing::saturate(D, m_gains.saturation);
    const Eigen::Vector3d v = -m_gains.lambda * (error.R.transpose() * error.t);
    return {vpServoPose::twist(v, -rotationGain() * rotationError), vpServoStatus::Servoing};
  }
};
} // namespace

std::unique_ptr<vpServoLaw> vpServoLaws::makeFeedforwardSum(const std::string &id, const vpServoGains &gains,
                                                            double rotationFactor)
{
  return std::make_unique<vpServoFeedforwardSum>(id, gains, rotationFactor);
}

END_VISP_NAMESPACE
