/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpSimulatedArmCore.h"

#include <visp3/core/vpException.h>
#include <visp3/robot/vpRobotException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// rad/s or m/s: a joint at a limit is led back by what rounding puts it beyond, again and again.
constexpr double standing = 1e-9;

// A control period is an integer number of joint control cycles.
vpArmDriveSpec driveSpec(const vpSimulatedArmSpec &spec)
{
  vpArmDriveSpec drives = spec.drives;
  drives.period = spec.redundancy.period / std::max(1., std::ceil(spec.redundancy.period / drives.period - 1e-9));
  return drives;
}
const vpArmModel &checked(const vpArmModel &model, const vpSimulatedArmSpec &spec)
{
  spec.validate(model);
  return model;
}
} // namespace

void vpRequireInside(const vpArmModel &model, const vpJointVector &q)
{
  const std::string wrong = model.outsideLimits(q);
  if (!wrong.empty()) {
    throw vpRobotException(vpRobotException::positionOutOfRangeError, "%s", wrong.c_str());
  }
}

void vpSimulatedArmSpec::validate(const vpArmModel &model) const
{
  redundancy.validate(model);
  closedLoop.validate(redundancy.period);
  drives.validate(model);
  if (start.size() != 0 && (start.size() != model.size() || !start.allFinite())) {
    throw vpException(vpException::badValue, "start of the simulated arm has %d numbers, must have %d finite ones",
                      static_cast<int>(start.size()), model.size());
  }
  if (start.size() != 0) {
    vpRequireInside(model, start);
  }
  if (indices.size() > static_cast<std::size_t>(vpMaxArmIndices)) {
    throw vpException(vpException::badValue, "%d indices for the simulated arm, must be at most %d",
                      static_cast<int>(indices.size()), vpMaxArmIndices);
  }
  for (const vpSelfMotionIndex &index : indices) {
    index.validate(model);
  }
  for (const auto &field : {std::make_pair("watchdog", watchdog), std::make_pair("followingError", followingError)}) {
    if (!(field.second > 0.)) {
      throw vpException(vpException::badValue, "%s of the simulated arm is %g, must be > 0", field.first, field.second);
    }
  }
}

vpSimulatedArmCore::vpSimulatedArmCore(const vpArmModel &arm, const vpSimulatedArmSpec &armSpec)
  : model(checked(arm, armSpec)), spec(armSpec), m_motion(model, spec.redundancy, spec.closedLoop),
    m_drives(model, driveSpec(spec))
{
  m_motion.setSelfMotion(spec.indices, spec.free);
  m_drives.reset(spec.start.size() > 0 ? spec.start : model.home());
}

void vpSimulatedArmCore::commandUntil(double deadline) { m_deadline = deadline; }

void vpSimulatedArmCore::stop()
{
  m_motion.hold();
  m_lost = vpJointShortfall();
}

bool vpSimulatedArmCore::atRest() const noexcept
{
  return m_motion.kind() == vpArmTaskKind::Hold && m_drives.command().cwiseAbs().maxCoeff() <= standing;
}

void vpSimulatedArmCore::tick() noexcept
{
  const bool byVelocity = m_motion.kind() == vpArmTaskKind::JointVelocity || m_motion.kind() == vpArmTaskKind::Twist;
  const bool stale = byVelocity && time() > m_deadline + 1e-9;
  if (stale) {
    m_motion.hold();
  }
  // Paths to a position bring their own integral: their next point is the desired configuration.
  const bool measured = byVelocity && spec.drives.reference == vpDriveReference::Measured && !spec.drives.ideal;
  m_drives.setReference(measured ? vpDriveReference::Measured : vpDriveReference::Integrated);
  m_drives.move(m_motion.step(measured ? m_drives.measured() : m_drives.wanted(), m_drives.command()),
                m_motion.period());
  ++m_periods;
  superviseDrives();
  const bool wasStale = m_status == vpSimulatedArmStatus::Stale && m_motion.kind() == vpArmTaskKind::Hold;
  m_status = stale || wasStale ? vpSimulatedArmStatus::Stale : judge();
}

void vpSimulatedArmCore::superviseDrives() noexcept
{
  if (m_lost.joint >= 0) {
    return;
  }
  Eigen::Index joint = 0;
  if ((m_drives.wanted() - m_drives.measured()).cwiseAbs().maxCoeff(&joint) > spec.followingError) {
    m_lost = {static_cast<int>(joint), m_drives.needed()(joint), m_drives.torque()(joint)};
    m_motion.hold();
    m_drives.holdHere();
  }
}

vpSimulatedArmStatus vpSimulatedArmCore::judge() const noexcept
{
  if (m_lost.joint >= 0) {
    return vpSimulatedArmStatus::NotFollowing;
  }
  if (atRest()) {
    return vpSimulatedArmStatus::Stopped;
  }
  if (m_motion.kind() == vpArmTaskKind::Hold) {
    return vpSimulatedArmStatus::Moving;
  }
  switch (m_motion.solver().status) {
  case vpRedundancyStatus::Exact:
  case vpRedundancyStatus::Accelerating:
    return vpSimulatedArmStatus::Moving;
  case vpRedundancyStatus::BlockedByLimits:
  case vpRedundancyStatus::BlockedBySingularity:
    return vpSimulatedArmStatus::Blocked;
  default:
    return vpSimulatedArmStatus::Limited;
  }
}

vpSimulatedArmState vpSimulatedArmCore::state() const
{
  return {time(),
          m_drives.q(),
          m_drives.velocity(),
          m_drives.wanted(),
          m_drives.command(),
          m_drives.torque(),
          m_drives.needed(),
          m_drives.saturated(),
          m_lost,
          m_motion.solver(),
          m_status};
}

std::string vpSimulatedArmCore::message() const
{
  switch (m_status) {
  case vpSimulatedArmStatus::Stopped:
    return "the arm is at rest";
  case vpSimulatedArmStatus::Moving:
    return "the arm does what it was asked to";
  case vpSimulatedArmStatus::Stale:
    return "the last velocity is too old, the arm has braked and holds";
  case vpSimulatedArmStatus::NotFollowing:
    return "joint " + model.spec().joints[static_cast<std::size_t>(m_lost.joint)].name +
           " did not follow its command (" + m_lost.message(model) + "), the arm holds until it is stopped";
  default:
    return m_motion.solver().message();
  }
}

vpArmData vpSimulatedArmCore::kinematics() const
{
  vpArmData data;
  vpArmKinematics::update(model, m_drives.q(), data);
  return data;
}

vpArmData vpSimulatedArmCore::measuredKinematics() const
{
  vpArmData data;
  vpArmKinematics::update(model, m_drives.measured(), data);
  return data;
}

const char *vpToString(vpSimulatedArmStatus status)
{
  switch (status) {
  case vpSimulatedArmStatus::Stopped:
    return "stopped";
  case vpSimulatedArmStatus::Moving:
    return "moving";
  case vpSimulatedArmStatus::Limited:
    return "limited";
  case vpSimulatedArmStatus::Blocked:
    return "blocked";
  case vpSimulatedArmStatus::Stale:
    return "stale";
  case vpSimulatedArmStatus::NotFollowing:
    return "not following";
  }
  return "";
}

END_VISP_NAMESPACE
