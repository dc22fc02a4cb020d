/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "planeMotion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace avoidObstacle
{
vpFieldWeightSpec strictField() { return {0.12, 0.06, 0.5}; }
vpFieldWeightSpec mildField() { return {0.06, 0.03, 0.5}; }

FieldMotion followField(const FieldTask &task, const vpFieldWeightSpec &weight, bool withObstacle)
{
  weight.validate(vpFieldForm::Thesis);
  constexpr double noWeight = 1e3; // m: far enough to have no effect
  FieldMotion motion;
  motion.weight = weight;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  double now = 0.;
  for (std::size_t i = 0; i < task.places.size(); ++i) {
    const double slot = i + 1 == task.places.size() ? 2. * task.slot : task.slot;
    const long cycles = std::lround(slot / task.period);
    for (long k = 0; k < cycles; ++k) {
      const Eigen::Vector2d offset = task.obstacle - x;
      const bool seen = withObstacle && std::fabs(offset.y()) <= task.sight;
      const double u = seen ? offset.x() : noWeight;
      const Eigen::Vector2d wish = task.gain * (task.places[i] - x);
      const Eigen::Vector3d avoid(offset.x() < 0. ? task.avoidSpeed : -task.avoidSpeed, 0., 0.);
      const Eigen::Vector3d v = vpBlendAsPrinted(weight, {u, noWeight}, avoid, {wish.x(), wish.y(), 0.});
      motion.times.push_back(now);
      motion.way.push_back(x);
      motion.weights.push_back(seen ? vpFieldWeight(weight, vpFieldForm::Thesis, u) : 0.);
      motion.peakSpeed = std::max(motion.peakSpeed, v.norm());
      x += task.period * v.head<2>();
      now += task.period;
    }
    motion.missed.push_back((task.places[i] - x).norm());
  }
  motion.times.push_back(now);
  motion.way.push_back(x);
  motion.weights.push_back(motion.weights.back());
  return motion;
}

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
