/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpToolForecast.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double lag = 0.01;     // m: maximum lag of a tool that follows its motion
constexpr double arrival = 2e-3; // m: tolerance for arrival at the end
constexpr double settling = 0.6; // s after the end for the arm to catch up

vpToolMotionSpec coarse(vpToolMotionSpec spec, double step)
{
  spec.period = step;
  return spec;
}

//! Largest motion of a capsule's end between two configurations.
double largestWay(const vpCollisionData &a, const std::array<vpPlacedCapsule, vpArmMaxCapsules> &b, int count)
{
  double way = 0.;
  for (int i = 0; i < count; ++i) {
    const vpPlacedCapsule &x = a.capsules[static_cast<std::size_t>(i)], &y = b[static_cast<std::size_t>(i)];
    way = std::max({way, (x.from - y.from).squaredNorm(), (x.to - y.to).squaredNorm()});
  }
  return std::sqrt(way);
}

vpClearance leastOf(const vpNearPairs &near)
{
  vpClearance least;
  for (int i = 0; i < near.count; ++i) {
    const vpClearance &pair = near.pairs[static_cast<std::size_t>(i)];
    least = pair.distance < least.distance ? pair : least;
  }
  return least;
}
} // namespace

vpToolForecast::vpToolForecast(const vpCollisionScene &scene, const vpToolMotionSpec &motion, double step)
  : m_scene(&scene), m_step(step), m_motion(scene.arm(), coarse(motion, step))
{}

vpForecast vpToolForecast::run(const vpJointVector &q, const vpJointVector &velocity, const vpTrajectoryPlan &plan,
                               double clock, const vpJointVector &posture, const Eigen::Matrix3d &orientation,
                               double margin, double later) noexcept
{
  vpForecast result;
  result.end = q;
  result.velocity = velocity;
  vpRedundancyOutput solved;
  const double cutoff = std::max(m_motion.spec().repelRange, margin + 0.1);
  const double duration = plan.duration();
  std::array<vpPlacedCapsule, vpArmMaxCapsules> before;
  bool limited = false;
  for (double t = 0.;; t += m_step) {
    m_scene->place(result.end, m_data);
    m_scene->near(m_data, cutoff, m_near, later + t);
    const double way = t > 0. ? largestWay(m_data, before, m_scene->capsuleCount()) : 0.;
    before = m_data.capsules;
    result.time = t;
    result.tool = m_data.arm.tool.p;
    if (!m_data.placed) {
      return result; // stuck: the configuration is not finite
    }
    const vpClearance nearest = leastOf(m_near);
    if (t == 0.) { // an arm within the margin may stay at slightly less than its clearance
      margin = std::min(margin, std::max(1e-3, nearest.distance - 1e-3));
    }
    else if (nearest.distance < margin + 0.5 * way) {
      result.pair = nearest;
      result.status = vpForecastStatus::Conflict;
      return result;
    }
    const Eigen::Vector3d wanted = vpToolPath::at(plan, std::min(duration, clock + t)).x;
    const double behind = (wanted - result.tool).norm();
    const bool over = clock + t >= duration;
    if (over && behind < arrival) {
      result.status = vpForecastStatus::Free;
      return result;
    }
    if (behind > lag || clock + t >= duration + settling) {
      result.status = limited ? vpForecastStatus::Stuck : vpForecastStatus::TooFast;
      return result;
    }
    const Eigen::Vector3d next = vpToolPath::at(plan, std::min(duration, clock + t + m_step)).x;
    m_motion.step(m_data, m_near, (next - result.tool) / m_step, posture, orientation, result.velocity, solved);
    limited = solved.status == vpRedundancyStatus::BlockedByLimits ||
              solved.status == vpRedundancyStatus::BlockedBySingularity || solved.stoppedJoints != 0;
    result.velocity = solved.velocity;
    result.end += m_step * solved.velocity;
  }
}

END_VISP_NAMESPACE
