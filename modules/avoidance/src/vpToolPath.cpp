/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpToolPath.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

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

END_VISP_NAMESPACE
