/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpFrictionCamera.h>

#include <visp3/core/vpExponentialMap.h>
#include <visp3/robot/vpRobotException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

vpFrictionCamera::vpFrictionCamera(const vpServoPlant &plant) : m_lag(plant.lag), m_deadband(plant.deadband)
{
  plant.validate();
  setSamplingTime(1. / plant.loopRate);
  setMaxTranslationVelocity(plant.maxLinear);
  setMaxRotationVelocity(plant.maxAngular);
}

void vpFrictionCamera::setVelocity(const vpRobot::vpControlFrameType frame, const vpColVector &v)
{
  if (frame != vpRobot::CAMERA_FRAME && frame != vpRobot::ARTICULAR_FRAME) {
    throw vpRobotException(vpRobotException::wrongStateError,
                           "vpFrictionCamera takes velocities in the camera frame only, asked for frame %d",
                           static_cast<int>(frame));
  }
  const vpTwist asked = vpTwist::fromColVector(v);
  for (unsigned int i = 0; i < 6; ++i) {
    if (!std::isfinite(asked[i])) {
      throw vpException(vpException::badValue, "component %u of the velocity is %g, must be finite", i, asked[i]);
    }
  }
  if (getRobotState() != vpRobot::STATE_VELOCITY_CONTROL) {
    setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  }
  setRobotFrame(frame);

  const vpTwist limited = vpLimitTwist(asked, getMaxTranslationVelocity(), getMaxRotationVelocity());
  // The command is constant over the cycle, so this blend is the exact response of y' = (v - y) / lag.
  const double share = m_lag > 0. ? -std::expm1(-getSamplingTime() / m_lag) : 1.;
  for (unsigned int i = 0; i < 6; ++i) {
    m_response[i] += share * (limited[i] - m_response[i]);
    const double lost = i < 3 ? 0. : m_deadband;
    m_actual[i] = std::copysign(std::max(std::fabs(m_response[i]) - lost, 0.), m_response[i]);
  }
  wMc_ = wMc_ * vpExponentialMap::direct(m_actual.toColVector(), getSamplingTime());
}

vpRobot::vpRobotStateType vpFrictionCamera::setRobotState(const vpRobot::vpRobotStateType newState)
{
  if (newState == vpRobot::STATE_STOP) {
    m_response = vpTwist();
    m_actual = vpTwist();
  }
  return vpSimulatorCamera::setRobotState(newState);
}

END_VISP_NAMESPACE
