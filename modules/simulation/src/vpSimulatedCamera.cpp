/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpFrictionCamera.h>
#include <visp3/simulation/vpVisionChannel.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpExponentialMap.h>
#include <visp3/robot/vpRobotException.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

namespace
{
// Tolerance of times, since 0.1 + 0.2 must count as 0.3; far below any cycle.
constexpr double timeTolerance = 1e-9;
} // namespace

vpVisionChannel::vpVisionChannel(double frameRate, double latency) : m_frameRate(frameRate), m_latency(latency)
{
  if (!(frameRate > 0.) || !std::isfinite(frameRate)) {
    throw vpException(vpException::badValue, "frame rate is %g Hz, must be > 0 and finite", frameRate);
  }
  if (!(latency >= 0.) || !std::isfinite(latency)) {
    throw vpException(vpException::badValue, "latency is %g s, must be >= 0 and finite", latency);
  }
}

bool vpVisionChannel::due(double now) const { return now + timeTolerance >= m_nextFrame / m_frameRate; }

void vpVisionChannel::push(const vpServoMeasurement &measurement)
{
  m_pending.push_back(measurement);
  // Counted from the start, not from this exposure, so that a late frame does not shift later ones.
  m_nextFrame = std::floor((measurement.time + timeTolerance) * m_frameRate) + 1.;
}

bool vpVisionChannel::pop(double now, vpServoMeasurement &result)
{
  if (m_pending.empty() || m_pending.front().time + m_latency > now + timeTolerance) {
    return false;
  }
  result = std::move(m_pending.front());
  m_pending.pop_front();
  return true;
}

END_VISP_NAMESPACE
