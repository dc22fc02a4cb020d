/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpToolMotion.h"

#include <visp3/direct_core/vpSO3.h>

#include <algorithm>
#include <cmath>

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

double vpToolTask::length(const Eigen::Vector3d &from) const noexcept
{
  double sum = 0.;
  Eigen::Vector3d last = from;
  for (int k = 0; k < viaCount; ++k) {
    sum += (vias[static_cast<std::size_t>(k)] - last).norm();
    last = vias[static_cast<std::size_t>(k)];
  }
  return sum + (goal - last).norm();
}

vpToolPath::vpToolPath(double maxVelocity, double maxAcceleration)
  : m_maxVelocity(maxVelocity), m_maxAcceleration(maxAcceleration), m_problem(3, vpToolTask::maxVias),
    m_planner(3, vpToolTask::maxVias)
{
  std::fill_n(m_problem.field(vpTrajectoryProblem::MaxAcceleration), 3, maxAcceleration);
  m_problem.spec.groups[0] = vpAxisGroup({0, 1, 2}, maxVelocity, maxAcceleration);
}

bool vpToolPath::plan(const vpToolState &from, const vpToolTask &task, vpTrajectoryPlan &plan) noexcept
{
  const double limit = m_maxVelocity * task.speed;
  std::fill_n(m_problem.field(vpTrajectoryProblem::MaxVelocity), 3, limit);
  m_problem.spec.groups[0].maxSpeed = limit;
  for (int i = 0; i < 3; ++i) {
    m_problem.setStart(i, {from.x(i), from.v(i), from.a(i), 0.});
    m_problem.field(vpTrajectoryProblem::GoalQ)[i] = task.goal(i);
    m_problem.field(vpTrajectoryProblem::GoalV)[i] = task.goalVelocity(i);
  }
  const double length = task.length(from.x);
  double way = 0.;
  Eigen::Vector3d last = from.x;
  m_problem.setViaCount(task.viaCount);
  for (int k = 0; k < task.viaCount; ++k) {
    const Eigen::Vector3d &via = task.vias[static_cast<std::size_t>(k)];
    way += (via - last).norm();
    last = via;
    m_problem.setVia(k, way / length, via.data(), nullptr, nullptr);
  }
  // A straight motion stays on its line.
  m_problem.spec.synchronisation = task.viaCount == 0 ? vpSynchronisation::Straight : vpSynchronisation::Time;
  return m_problem.validate(true).isGood() && m_planner.plan(m_problem, 0., plan).isGood();
}

// From (v, 0) to rest in T = 1.5 |v|/a over v T/2 the quintic is a quartic with the peak acceleration a.
bool vpToolPath::stop(const vpToolState &from, vpTrajectoryPlan &plan) noexcept
{
  vpToolTask task;
  const double time = 1.5 * from.v.norm() / m_maxAcceleration;
  task.goal = from.x + 0.5 * time * from.v;
  return this->plan(from, task, plan);
}

void vpToolPath::hold(const Eigen::Vector3d &x, vpTrajectoryPlan &plan) noexcept
{
  plan.clear();
  for (int i = 0; i < 3; ++i) {
    plan.begin(i, x(i), vpTrajectoryForm::Hold);
    plan.finish(i, {x(i), 0., 0., 0.});
  }
}

vpToolState vpToolPath::at(const vpTrajectoryPlan &plan, double t) noexcept
{
  vpToolState state;
  for (int i = 0; i < 3; ++i) {
    const vpAxisState x = plan.at(i, t);
    state.x(i) = x[0];
    state.v(i) = x[1];
    state.a(i) = x[2];
  }
  return state;
}

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
    int joint = std::min(link, m_model->links() - 1);
    if (link >= 1 && link < m_model->links()) { // the nearer of its two ends
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
