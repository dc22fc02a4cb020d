/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/manipulator/vpArmMotion.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

vpArmMotion::vpArmMotion(const vpArmModel &model, const vpRedundancySpec &redundancy,
                         const vpClosedLoopSpec &closedLoop)
  : m_model(&model), m_solver(model, redundancy), m_loop(model, redundancy, closedLoop), m_pathInput(model.size()),
    m_pathOutput(model.size()), m_path(model.size())
{
  m_velocity.setZero(model.size());
  m_wanted.setZero(model.size());
  m_closed.solver.velocity = m_closed.solver.selfMotion = m_velocity;
  m_pathInput.maxAcceleration = model.acceleration();
  m_pathInput.minPosition = model.lower();
  m_pathInput.maxPosition = model.upper();
}

void vpArmMotion::jointVelocity(const vpJointVector &velocity)
{
  m_kind = vpArmTaskKind::JointVelocity;
  m_wanted = velocity;
}

void vpArmMotion::twist(const vpTwist &twist, vpArmTwistFrame frame)
{
  m_kind = vpArmTaskKind::Twist;
  m_twist = twist;
  m_frame = frame;
}

void vpArmMotion::jointPath(const vpJointVector &goal, const vpJointVector &q, const vpJointVector &velocity,
                            double share)
{
  m_kind = vpArmTaskKind::JointPath;
  m_finished = m_failed = false;
  m_pathInput.start.q = q;
  m_pathInput.start.v = velocity;
  m_pathInput.goal.q = goal.cwiseMax(m_model->lower()).cwiseMin(m_model->upper()); // may be beyond by the tolerance
  m_pathInput.maxVelocity = share * m_model->velocity();
  m_path.reset();
}

void vpArmMotion::posePath(const vpRigidTransform &goal, const vpJointVector &q, const vpJointVector &velocity)
{
  m_kind = vpArmTaskKind::PosePath;
  m_finished = false;
  m_pose.goal = goal;
  m_closedState = vpClosedLoopState();
  m_closedState.q = q;
  m_closedState.velocity = velocity;
}

void vpArmMotion::setSelfMotion(const std::vector<vpSelfMotionIndex> &indices, const std::array<bool, 6> &free)
{
  const int count = std::min(static_cast<int>(indices.size()), vpMaxArmIndices);
  std::copy_n(indices.begin(), count, m_input.indices.begin());
  m_pose.indices = m_input.indices;
  m_input.indexCount = m_pose.indexCount = count;
  m_input.free = m_pose.free = free;
}

const vpJointVector &vpArmMotion::step(const vpJointVector &q, const vpJointVector &velocity) noexcept
{
  switch (m_kind) {
  case vpArmTaskKind::Hold:
    clamped(q, velocity, vpJointVector::Zero(m_model->size()));
    break;
  case vpArmTaskKind::JointVelocity:
    clamped(q, velocity, m_wanted);
    break;
  case vpArmTaskKind::Twist:
    followTwist(q, velocity);
    break;
  case vpArmTaskKind::JointPath:
    followPath(q, velocity);
    break;
  case vpArmTaskKind::PosePath:
    followPose();
    break;
  }
  return m_velocity;
}

// Each joint separately: only the one that reaches a limit is stopped.
void vpArmMotion::clamped(const vpJointVector &q, const vpJointVector &velocity, const vpJointVector &wanted) noexcept
{
  m_bounds.update(*m_model, q, velocity, period(), 0.);
  vpRedundancyOutput &out = m_closed.solver;
  out.status = vpRedundancyStatus::Exact;
  out.stoppedJoints = out.saturatedJoints = out.unreachableAxes = 0;
  out.selfMotion.setZero(m_model->size());
  for (int i = 0; i < m_model->size(); ++i) {
    m_velocity(i) = m_bounds.clamp(i, wanted(i));
    const bool atStop = (wanted(i) > 0. && m_velocity(i) > m_bounds.upper(i) - 1e-9 && wanted(i) > m_bounds.upper(i)) ||
                        (wanted(i) < 0. && m_velocity(i) < m_bounds.lower(i) + 1e-9 && wanted(i) < m_bounds.lower(i));
    const bool byPosition = atStop && std::min(m_bounds.roomAbove(i), m_bounds.roomBelow(i)) < 1e-3;
    if (byPosition) {
      out.stoppedJoints |= 1U << i;
      out.status = vpRedundancyStatus::JointsStopped;
    }
    else if (m_velocity(i) != wanted(i) && out.status == vpRedundancyStatus::Exact) {
      out.status = vpRedundancyStatus::Accelerating;
    }
  }
  out.velocity = m_velocity;
}

void vpArmMotion::followTwist(const vpJointVector &q, const vpJointVector &velocity) noexcept
{
  vpArmKinematics::update(*m_model, q, m_data);
  m_input.previous = velocity;
  m_input.twist = m_twist;
  switch (m_frame) {
  case vpArmTwistFrame::Base:
    m_input.frame = vpArmFrame::Base;
    break;
  case vpArmTwistFrame::EndEffector:
    m_input.frame = vpArmFrame::EndEffector;
    break;
  case vpArmTwistFrame::Camera:
    m_input.frame = vpArmFrame::Camera;
    break;
  case vpArmTwistFrame::Mixt: {
    // Velocity of the camera's origin along the axes of the base, rotation about the axes of the camera.
    const Eigen::Matrix3d cRf = vpArmKinematics::camera(*m_model, m_data).R.transpose();
    const Eigen::Vector3d v = cRf * Eigen::Vector3d(m_twist[0], m_twist[1], m_twist[2]);
    m_input.frame = vpArmFrame::Camera;
    m_input.twist = vpTwist(v.x(), v.y(), v.z(), m_twist[3], m_twist[4], m_twist[5]);
    break;
  }
  }
  m_solver.step(m_data, m_input, m_closed.solver);
  m_velocity = m_closed.solver.velocity;
}

void vpArmMotion::followPath(const vpJointVector &q, const vpJointVector &velocity) noexcept
{
  const vpTrajectoryResult result = m_path.step(m_pathInput, m_pathOutput, period());
  m_failed = !m_pathOutput.status.isGood();
  if (m_failed) { // no next state
    m_finished = true;
    hold();
    clamped(q, velocity, vpJointVector::Zero(m_model->size()));
    return;
  }
  m_velocity = (m_pathOutput.state.q - q) / period();
  m_closed.solver.status = vpRedundancyStatus::Exact;
  m_closed.solver.stoppedJoints = m_closed.solver.saturatedJoints = 0;
  m_closed.solver.unreachableAxes = 0;
  m_closed.solver.selfMotion.setZero(m_model->size());
  if (result == vpTrajectoryResult::Finished || result == vpTrajectoryResult::Holding) {
    m_finished = true;
    hold();
  }
}

void vpArmMotion::followPose() noexcept
{
  m_loop.step(m_pose, m_closedState, m_closed);
  m_velocity = m_closedState.velocity;
  if (m_closedState.status != vpClosedLoopStatus::Moving) {
    m_finished = true;
    hold();
  }
}

END_VISP_NAMESPACE
