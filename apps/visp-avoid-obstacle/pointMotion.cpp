/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "pointMotion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace avoidObstacle
{
namespace
{
constexpr int DENSE = 10;       // evaluations per period
constexpr double LONGEST = 30.; // s

double norm(const vpTrajectoryPlan &plan, double t, int order)
{
  return std::hypot(plan.at(0, t)[static_cast<std::size_t>(order)], plan.at(1, t)[static_cast<std::size_t>(order)]);
}

vpTrajectoryInput<2> inputOf(const PointTask &task)
{
  vpTrajectoryInput<2> input;
  input.start.q = task.start;
  input.goal.q = task.goal;
  input.maxVelocity.setConstant(task.maxSpeed);
  input.maxAcceleration.setConstant(task.maxAcceleration);
  input.spec.groups[0] = vpAxisGroup({0, 1}, task.maxSpeed, task.maxAcceleration);
  input.spec.minimumDuration = task.floor;
  if (task.told) {
    input.spec.policy = vpReplanPolicy::KeepArrival;
  }
  return input;
}

void take(const PointEvent &event, double share, vpTrajectoryInput<2> &input)
{
  input.goal.q = event.goal;
  input.vias.clear();
  if (event.via) {
    input.vias.emplace_back();
    input.vias.back().q = *event.via;
    input.vias.back().tau = share;
  }
}

void look(const vpDirectTrajectory<2> &trajectory, const vpTrajectoryOutput<2> &output, PointMotion &motion)
{
  for (int k = 0; k < DENSE; ++k) {
    const double t = std::max(0., output.time - pointPeriod * k / DENSE);
    motion.peakSpeed = std::max(motion.peakSpeed, norm(trajectory.plan(), t, 1));
    motion.peakAcceleration = std::max(motion.peakAcceleration, norm(trajectory.plan(), t, 2));
  }
}
} // namespace

PointMotion follow(const PointTask &task)
{
  vpTrajectoryInput<2> input = inputOf(task);
  vpDirectTrajectory<2> trajectory(2, 1);
  vpTrajectoryOutput<2> output;
  PointMotion motion;
  motion.samples.push_back({0., task.start, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), task.goal});
  const long toldEvery = std::lround(task.toldEvery / pointPeriod);
  std::size_t next = 0;
  for (long i = 0; i * pointPeriod < LONGEST; ++i) {
    const double now = static_cast<double>(i) * pointPeriod;
    if (task.told && i % toldEvery == 0) {
      input.goal.q = task.told(now);
    }
    for (; next < task.events.size() && task.events[next].time <= now + 0.5 * pointPeriod; ++next) {
      take(task.events[next], task.viaShare, input);
    }
    const vpTrajectoryResult result = trajectory.step(input, output, pointPeriod);
    if (!output.status.isGood()) {
      throw std::runtime_error("the trajectory refuses its task at " + std::to_string(now) +
                               " s: " + output.status.message());
    }
    look(trajectory, output, motion);
    motion.jump = std::max(motion.jump, (output.state.a - motion.samples.back().acceleration).norm());
    motion.plans += output.newPlan ? 1 : 0;
    motion.samples.push_back({now + pointPeriod, output.state.q, output.state.v, output.state.a, input.goal.q});
    const bool rests =
        (result == vpTrajectoryResult::Finished || result == vpTrajectoryResult::Holding) && next == task.events.size();
    motion.arrival = rests && motion.arrived ? motion.arrival : now + pointPeriod;
    motion.arrived = rests;
    if (rests && now + pointPeriod >= task.duration) {
      break;
    }
  }
  return motion;
}
} // namespace avoidObstacle
