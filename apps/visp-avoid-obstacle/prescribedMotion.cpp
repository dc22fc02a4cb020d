/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "prescribedMotion.h"

#include <algorithm>

namespace avoidObstacle
{
namespace
{
constexpr double FOLLOWING_GAIN = 10.; // 1/s: gain that recovers lag caused by joint limits

vpRedundancySpec solverSpec(double period)
{
  vpRedundancySpec spec;
  spec.period = period;
  return spec;
}
} // namespace

PrescribedMotion::PrescribedMotion(const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec,
                                   std::vector<ToolEvent> events, double viaShare)
  : m_arm(&scene.arm()), m_spec(spec), m_events(std::move(events)), m_viaShare(viaShare),
    m_solver(scene.arm(), solverSpec(spec.period)), m_trajectory(3, 1)
{
  m_input.vias.reserve(1);
  m_input.maxVelocity.setConstant(spec.maxVelocity);
  m_input.maxAcceleration.setConstant(spec.maxAcceleration);
  m_input.spec.groups[0] = vpAxisGroup({0, 1, 2}, spec.maxVelocity, spec.maxAcceleration);
  m_wish.frame = vpArmFrame::Base;
  m_wish.free = {false, false, false, true, true, true};
}

vpAvoidanceStatus PrescribedMotion::start(const vpJointVector &q, const vpAvoidanceGoal &)
{
  vpArmKinematics::forward(*m_arm, q, m_data);
  m_trajectory.reset();
  m_input.start.q = m_input.goal.q = m_data.tool.p;
  m_input.vias.clear();
  m_wish.previous = vpJointVector::Zero(q.size());
  m_next = 0;
  m_cycle = 0;
  return vpAvoidanceStatus::Moving;
}

void PrescribedMotion::take(const ToolEvent &event) noexcept
{
  m_input.goal.q = event.goal;
  m_input.vias.clear();
  if (event.via) {
    m_input.vias.emplace_back(); // within its capacity
    m_input.vias.back().q = *event.via;
    m_input.vias.back().tau = m_viaShare;
  }
}

void PrescribedMotion::step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept
{
  const double now = static_cast<double>(m_cycle++) * m_spec.period;
  for (; m_next < m_events.size() && m_events[m_next].time <= now + 0.5 * m_spec.period; ++m_next) {
    take(m_events[m_next]);
  }
  const Eigen::Vector3d before = m_cycle == 1 ? m_input.start.q : m_output.state.q; // desired tool position now
  const vpTrajectoryResult result = m_trajectory.step(m_input, m_output, m_spec.period);
  vpArmKinematics::forward(*m_arm, q, m_data);
  vpArmKinematics::jacobian(*m_arm, m_data);
  Eigen::Vector3d v = (m_output.state.q - before) / m_spec.period + FOLLOWING_GAIN * (before - m_data.tool.p);
  v *= std::min(1., m_spec.maxVelocity / std::max(1e-9, v.norm()));
  m_wish.twist = vpTwist(v.x(), v.y(), v.z(), 0., 0., 0.);
  m_solver.step(m_data, m_wish, m_solved);
  m_wish.previous = m_solved.velocity;
  output = vpAvoidanceOutput();
  output.velocity = m_solved.velocity;
  output.wanted = m_output.state.q;
  const bool rests =
      (result == vpTrajectoryResult::Finished || result == vpTrajectoryResult::Holding) && m_next == m_events.size();
  output.status = rests        ? vpAvoidanceStatus::Arrived
                  : m_next > 1 ? vpAvoidanceStatus::Detouring
                               : vpAvoidanceStatus::Moving;
}
} // namespace avoidObstacle
