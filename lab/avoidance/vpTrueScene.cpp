/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpTrueScene.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

vpTrueScene::vpTrueScene(const vpAvoidanceRunSpec &spec) : m_scene(*spec.arm, spec.scene)
{
  for (const vpMovingObstacle &motion : spec.obstacles) {
    m_obstacles.push_back({motion, -1});
    m_fastest = std::max(m_fastest, motion.object.velocity.linearNorm());
  }
}

void vpTrueScene::enter(double t)
{
  for (Obstacle &o : m_obstacles) {
    const bool there = o.motion.isThere(t);
    if (there && o.index < 0) {
      m_scene.add(o.motion.object);
    }
    else if (!there && o.index >= 0) {
      m_scene.remove(m_scene.find(o.motion.object.name));
    }
    o.index = there ? 0 : -1;
  }
  for (Obstacle &o : m_obstacles) { // those after a removed one have moved up
    o.index = o.index >= 0 ? m_scene.find(o.motion.object.name) : -1;
  }
  place(t);
}

bool vpTrueScene::isStill(double t) const noexcept
{
  return std::all_of(m_obstacles.begin(), m_obstacles.end(), [t](const Obstacle &o) {
    const bool gone = t >= o.motion.vanishes;
    return gone ||
           (t >= o.motion.appears && std::isinf(o.motion.vanishes) && o.motion.object.velocity.linearNorm() == 0.);
  });
}

void vpTrueScene::place(double t) noexcept
{
  for (const Obstacle &o : m_obstacles) {
    if (o.index >= 0) {
      vpRigidTransform pose;
      vpTwist velocity;
      o.motion.stateAt(t, pose, velocity);
      static_cast<void>(m_scene.moveObject(o.index, pose));
      static_cast<void>(m_scene.setVelocity(o.index, velocity));
    }
  }
}

bool vpReachPoint(const vpArmModel &model, const Eigen::Vector3d &place, vpJointVector &q)
{
  constexpr int steps = 200;
  constexpr double longest = 0.05, close = 1e-9; // m
  vpArmData data;
  for (int i = 0; i < steps; ++i) {
    vpArmKinematics::update(model, q, data);
    Eigen::Vector3d error = place - data.tool.p;
    if (error.norm() < close) {
      return true;
    }
    const double damping = 1e-6 + 1e-3 * error.squaredNorm(); // vanishes at the end
    error *= std::min(1., longest / error.norm());
    const auto J = data.J.topRows<3>();
    const Eigen::Matrix3d JJ = J * J.transpose() + damping * Eigen::Matrix3d::Identity();
    q += J.transpose() * JJ.ldlt().solve(error);
    q = q.cwiseMax(model.lower()).cwiseMin(model.upper()).eval();
  }
  return false;
}

namespace
{
constexpr unsigned int stream = 0x60a1; // separate from those of the sensors

vpAvoidanceGoal between(const vpAvoidanceGoal &from, const vpAvoidanceGoal &to, double s)
{
  vpAvoidanceGoal goal;
  goal.position = from.position + s * (to.position - from.position);
  if (from.q.size() > 0 && from.q.size() == to.q.size()) {
    goal.q = from.q + s * (to.q - from.q);
  }
  return goal;
}
} // namespace

vpMovingGoal::vpMovingGoal(const vpAvoidanceRunSpec &spec)
  : m_spec(&spec), m_end(spec.goalMoves.empty() ? 0. : spec.goalMoves.back().end)
{
  std::seed_seq sequence{spec.seed, stream};
  m_random.seed(sequence);
}

vpAvoidanceGoal vpMovingGoal::at(double t) const
{
  vpAvoidanceGoal goal = m_spec->goal;
  for (const vpGoalMove &move : m_spec->goalMoves) {
    if (t < move.begin) {
      break;
    }
    goal = t < move.end ? between(goal, move.to, (t - move.begin) / (move.end - move.begin)) : move.to;
  }
  return goal;
}

bool vpMovingGoal::isDue(double t)
{
  constexpr double rounding = 1e-9;
  if (m_spec->goalMoves.empty() || t < m_next / m_spec->goalRate - rounding) {
    return false;
  }
  // Once more after the end, without noise, for the evaluation of the run.
  const bool due = m_next == 0. || (m_next - 1.) / m_spec->goalRate <= m_end;
  m_next += 1.;
  return due;
}

vpAvoidanceGoal vpMovingGoal::told(double t)
{
  vpAvoidanceGoal goal = at(t);
  if (m_spec->goalNoise > 0. && t <= m_end) {
    std::normal_distribution<double> normal(0., m_spec->goalNoise);
    for (int i = 0; i < 3; ++i) {
      goal.position(i) += normal(m_random);
    }
  }
  if (goal.q.size() > 0) {
    static_cast<void>(vpReachPoint(*m_spec->arm, goal.position, goal.q)); // as near as the arm can reach
  }
  return goal;
}

END_VISP_NAMESPACE
