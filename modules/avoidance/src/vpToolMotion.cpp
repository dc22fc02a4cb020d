/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpToolMotion.h"

#include <visp3/direct_core/vpSO3.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int mostRepelling = 3; // obstacles at a time

vpRedundancySpec solverSpec(double period)
{
  vpRedundancySpec spec;
  spec.period = period;
  spec.policy = vpLimitPolicy::StopJoints;
  spec.selfAcceleration = 0.2;
  spec.positionMargin = 0.005; // reserve for a tool that must not brake harder
  spec.selfMotion = 1.;
  spec.minSelfMotion = 1.;
  return spec;
}
} // namespace

vpToolMotion::vpToolMotion(const vpArmModel &model, const vpToolMotionSpec &spec)
  : m_model(&model), m_spec(spec), m_solver(model, solverSpec(spec.period))
{
  const bool free = !spec.keepOrientation;
  m_input.frame = vpArmFrame::Base;
  m_input.free = {false, false, false, free, free, free};
}

// The joint at the end of the link nearest to the obstacle moves away from it.
void vpToolMotion::repel(const vpCollisionData &data, const vpNearPairs &near) noexcept
{
  std::array<bool, vpNearPairs::capacity> used{};
  for (int k = 0; k < mostRepelling; ++k) {
    int nearest = -1;
    for (int i = 0; i < near.count; ++i) {
      const vpClearance &pair = near.pairs[static_cast<std::size_t>(i)];
      if (!used[static_cast<std::size_t>(i)] && pair.kind != vpCollisionKind::Self &&
          pair.distance < m_spec.repelRange &&
          (nearest < 0 || pair.distance < near.pairs[static_cast<std::size_t>(nearest)].distance)) {
        nearest = i;
      }
    }
    if (nearest < 0) {
      return;
    }
    used[static_cast<std::size_t>(nearest)] = true;
    const vpClearance &pair = near.pairs[static_cast<std::size_t>(nearest)];
    const int link = m_model->spec().capsules[static_cast<std::size_t>(pair.capsule)].link;
    int joint = std::min(link, m_model->size() - 1);
    if (link >= 1 && link < m_model->size()) { // the nearer of its two ends
      const double far = (data.arm.joint[static_cast<std::size_t>(link)].p - pair.onArm).norm();
      const double close = (data.arm.joint[static_cast<std::size_t>(link - 1)].p - pair.onArm).norm();
      joint = far <= close ? link : link - 1;
    }
    const double gain = 1. - std::max(0., pair.distance) / m_spec.repelRange;
    m_input.indices[static_cast<std::size_t>(m_input.indexCount++)] =
        vpSelfMotionIndex::pointDistance(joint, pair.onOther, vpIndexSense::Repel, gain, m_spec.repelRange);
  }
}

void vpToolMotion::step(vpCollisionData &data, const vpNearPairs &near, const Eigen::Vector3d &velocity,
                        const vpJointVector &posture, const Eigen::Matrix3d &orientation, const vpJointVector &previous,
                        vpRedundancyOutput &output, bool selfMotion) noexcept
{
  vpArmKinematics::jacobian(*m_model, data.arm);
  m_input.twist = vpTwist(velocity.x(), velocity.y(), velocity.z(), 0., 0., 0.);
  if (m_spec.keepOrientation) {
    const Eigen::Vector3d turn = m_spec.orientationGain * vpSO3::log(orientation * data.arm.tool.R.transpose());
    m_input.twist = vpTwist(velocity.x(), velocity.y(), velocity.z(), turn.x(), turn.y(), turn.z());
  }
  m_input.previous = previous;
  m_input.selfMotionShare = selfMotion ? 1. : 0.;
  m_input.indexCount = 0;
  m_input.indices[static_cast<std::size_t>(m_input.indexCount++)] = vpSelfMotionIndex::jointLimits(m_spec.limitGain);
  if (posture.size() == m_model->size()) {
    m_input.indices[static_cast<std::size_t>(m_input.indexCount++)] =
        vpSelfMotionIndex::posture(posture, m_spec.postureGain);
  }
  repel(data, near);
  m_solver.step(data.arm, m_input, output);
}

END_VISP_NAMESPACE
