/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"
#include "vpServoCheck.h"

#include <visp3/feedforward/vpOdometryBridge.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double timeTolerance = 1e-9;
// A point nearer than this is out of range of any lens, and its image coordinates become infinite.
constexpr double nearestDepth = 1e-3;

void transport(const Eigen::Matrix3d &R, const Eigen::Vector3d &t, const std::vector<vpServoPoint> &from,
               std::vector<vpServoPoint> &to)
{
  to = from;
  for (vpServoPoint &p : to) {
    if (!p.visible) {
      continue;
    }
    const Eigen::Vector3d P = R * (p.Z * Eigen::Vector3d(p.x, p.y, 1.)) + t;
    const double depth = P.z();
    if (!(depth >= nearestDepth && P.allFinite())) {
      p.visible = false;
      continue;
    }
    p.x = P.x() / depth;
    p.y = P.y() / depth;
    p.Z = depth;
  }
}
} // namespace

vpOdometryBridge::vpOdometryBridge(double maxAge, double rate) : m_maxAge(maxAge)
{
  constexpr vpFieldCheck fields("the odometry bridge");
  fields.positive("greatest age", maxAge, "s");
  fields.positive("rate", rate, "Hz");
  m_ring.resize(static_cast<std::size_t>(std::min(std::ceil(maxAge * rate) + 2., 1. * longestPath)));
}

vpOdometryBridge::Pose vpOdometryBridge::moved(const Pose &pose, const vpTwist &twist, double dt) noexcept
{
  const vpServoPose::Pose next =
      vpServoPose::moved({pose.R, pose.t}, vpServoPose::linear(twist), vpServoPose::angular(twist), dt);
  return {next.R, next.t};
}

// Restart the path here and now; older data cannot be predicted any more.
void vpOdometryBridge::restart(double time) noexcept
{
  m_first = 0;
  m_count = 1;
  m_ring[0] = Instant();
  m_ring[0].time = time;
  m_last.valid = false;
}

bool vpOdometryBridge::move(const vpTwist &twist, double time) noexcept
{
  const Instant &last = at(m_count - 1);
  const double dt = time - last.time;
  if (!(dt >= 0. && dt <= m_maxAge)) {
    restart(std::isfinite(time) ? time : last.time);
    return false;
  }
  const Instant next{time, moved(last.pose, twist, dt), twist};
  if (!next.pose.R.allFinite() || !next.pose.t.allFinite()) {
    restart(time);
    return false;
  }
  if (m_count == m_ring.size()) {
    m_first = (m_first + 1) % m_ring.size();
  }
  else {
    ++m_count;
  }
  m_ring[(m_first + m_count - 1) % m_ring.size()] = next;
  return true;
}

bool vpOdometryBridge::correct(const vpServoMeasurement &result) noexcept
{
  std::size_t i = m_count; // one past the last instant that is not later than the capture
  while (i > 0 && !(at(i - 1).time <= result.time + timeTolerance)) {
    --i;
  }
  const bool isLatest = i == m_count;
  if (i == 0 || (isLatest && !(result.time <= at(i - 1).time + timeTolerance))) {
    return false;
  }
  m_capture = at(i - 1).pose;
  const double rest = result.time - at(i - 1).time;
  if (!isLatest && rest > timeTolerance) { // between two instants
    m_capture = moved(m_capture, at(i).twist, rest);
  }
  m_last = result;
  return true;
}

double vpOdometryBridge::age() const noexcept
{
  return m_last.valid ? at(m_count - 1).time - m_last.time : std::numeric_limits<double>::infinity();
}

void vpOdometryBridge::predict(vpServoMeasurement &now) const noexcept
{
  now.time = m_last.time;
  now.valid = age() <= m_maxAge + timeTolerance;
  if (!now.valid) {
    return;
  }
  const Pose &camera = at(m_count - 1).pose;
  const Eigen::Matrix3d R = camera.R.transpose() * m_capture.R;
  const Eigen::Vector3d t = camera.R.transpose() * (m_capture.t - camera.t);
  vpHomogeneousMatrix &cMo = now.cMo;
  for (unsigned int row = 0; row < 3; ++row) {
    for (unsigned int k = 0; k < 4; ++k) {
      cMo[row][k] = R(row, 0) * m_last.cMo[0][k] + R(row, 1) * m_last.cMo[1][k] + R(row, 2) * m_last.cMo[2][k] +
                    (k == 3 ? t[row] : 0.);
    }
  }
  now.covariance = m_last.covariance;
  if (now.covariance.known) { // v and w of the error rotate with the camera
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> C(now.covariance.C.data());
    for (int block = 0; block < 6; block += 3) {
      C.middleRows<3>(block) = (R * C.middleRows<3>(block)).eval();
    }
    for (int block = 0; block < 6; block += 3) {
      C.middleCols<3>(block) = (C.middleCols<3>(block) * R.transpose()).eval();
    }
  }
  transport(R, t, m_last.points, now.points);
  transport(R, t, m_last.outline, now.outline);
  now.valid = cMo[2][3] > nearestDepth;
}

END_VISP_NAMESPACE
