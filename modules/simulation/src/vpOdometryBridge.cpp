/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpOdometryBridge.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpExponentialMap.h>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double timeTolerance = 1e-9;
// A point nearer than this has left every lens's range, and its image is about to become infinite.
constexpr double nearestDepth = 1e-3;

void transport(const vpHomogeneousMatrix &M, const std::vector<vpServoPoint> &from, std::vector<vpServoPoint> &to)
{
  to = from;
  for (vpServoPoint &p : to) {
    if (!p.visible) {
      continue;
    }
    const double X = p.x * p.Z, Y = p.y * p.Z, Z = p.Z;
    const double depth = M[2][0] * X + M[2][1] * Y + M[2][2] * Z + M[2][3];
    if (depth < nearestDepth) {
      p.visible = false;
      continue;
    }
    p.x = (M[0][0] * X + M[0][1] * Y + M[0][2] * Z + M[0][3]) / depth;
    p.y = (M[1][0] * X + M[1][1] * Y + M[1][2] * Z + M[1][3]) / depth;
    p.Z = depth;
  }
}
} // namespace

vpOdometryBridge::vpOdometryBridge() { m_path.push_back({0., vpHomogeneousMatrix()}); }

void vpOdometryBridge::move(const vpTwist &twist, double time)
{
  const Instant &last = m_path.back();
  m_path.push_back({time, last.pose * vpExponentialMap::direct(twist.toColVector(), time - last.time)});
}

void vpOdometryBridge::correct(const vpServoMeasurement &result)
{
  if (result.time > m_path.back().time + timeTolerance) {
    throw vpException(vpException::badValue, "a measurement was captured at %g s, later than the odometry at %g s",
                      result.time, m_path.back().time);
  }
  m_last = result;
  // Results come in the order of capture, so what happened before this one is never asked for again.
  while (m_path.size() > 1 && m_path[1].time <= result.time + timeTolerance) {
    m_path.pop_front();
  }
}

void vpOdometryBridge::predict(vpServoMeasurement &now) const
{
  now.time = m_last.time;
  now.valid = m_last.valid;
  if (!m_last.valid) {
    return;
  }
  const vpHomogeneousMatrix nMc = m_path.back().pose.inverse() * m_path.front().pose;
  now.cMo = nMc * m_last.cMo;
  transport(nMc, m_last.points, now.points);
  transport(nMc, m_last.outline, now.outline);
  now.valid = now.cMo[2][3] > nearestDepth;
}

END_VISP_NAMESPACE
