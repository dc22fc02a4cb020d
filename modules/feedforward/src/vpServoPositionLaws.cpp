/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpServoLaws.h"
#include "vpServoPose.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Geometry>

BEGIN_VISP_NAMESPACE

namespace
{
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

END_VISP_NAMESPACE
