/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The status of a cycle, and its sentence.
#include "vpServoControlSide.h"

BEGIN_VISP_NAMESPACE

namespace
{
using Status = vpVisualServoStatus;
}

void vpServoControlSide::conclude(Status images) noexcept
{
  const bool isPassed = m_output.supervision == vpSupervision::Passed ||
                        m_output.supervision == vpSupervision::Limited || m_output.supervision == vpSupervision::Slowed;
  if (m_fault != Status::Servoing) {
    m_output.status = m_fault;
  }
  else if (!m_isRunning) {
    m_output.status = Status::Idle;
  }
  else if (images != Status::Servoing) {
    m_output.status = images;
  }
  else if (!isPassed) {
    m_output.status = Status::Obstructed;
  }
  else if (!vpIsWorking(m_output.servo)) {
    m_output.status = Status::LawStopped;
  }
  else {
    m_output.status = m_within >= m_spec.convergedTime && m_within > 0. ? Status::Converged : Status::Servoing;
  }
  m_output.message = message();
}

const char *vpServoControlSide::message() const noexcept
{
  switch (m_output.status) {
  case Status::Servoing:
    return m_output.arm >= vpRedundancyStatus::JointsStopped ? m_motion->solver().message() : vpMessage(m_output.servo);
  case Status::Converged:
    return "The goal is reached within the tolerances.";
  case Status::Idle:
    return "The servo is not started; the robot stands or brakes.";
  case Status::LawStopped:
    return vpMessage(m_output.servo);
  case Status::Obstructed:
    return m_supervised.message();
  case Status::NoImages:
    return m_hasImage ? "No new image within the timeout: the robot stops until one comes."
                      : "There was no image yet: the robot waits for the first one.";
  case Status::FrozenImages:
    return "The image does not change although the camera moves: the robot stops until it does.";
  case Status::ImageClock:
    return m_isFuture ? "Images have times of capture in the future: the clocks of camera and control differ."
                      : "Images have times of capture that do not increase: the robot stops until they do.";
  case Status::LateStep:
    return "The clock jumped or a step came too late: the robot stops until an image comes that was taken afterwards.";
  case Status::ClockFault:
    return "The clock of the control thread stood, went back or is not finite: the robot stops until it is started "
           "again.";
  case Status::StateFault:
    return "The robot's state is missing, too old or not finite: the robot stops until it is started again.";
  case Status::NotFollowing:
    return "The robot does not move as commanded: it is stopped until it is started again.";
  }
  return "Unknown status.";
}

END_VISP_NAMESPACE
