/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/arm/vpSelfMotionExperiment.h"
#include "vpFieldCheck.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double period = 0.005; // s

constexpr vpFieldCheck fields("the self-motion experiment");

//! Desired tool position and velocity at time t: between positions by minimum jerk.
void reference(const vpSelfMotionRunSpec &spec, const Eigen::Vector3d &start, double t, Eigen::Vector3d &place,
               Eigen::Vector3d &velocity)
{
  const auto leg = static_cast<std::size_t>(t / spec.legTime);
  if (leg >= spec.places.size()) {
    place = spec.places.empty() ? start : spec.places.back();
    velocity.setZero();
    return;
  }
  const Eigen::Vector3d from = leg == 0 ? start : spec.places[leg - 1], way = spec.places[leg] - from;
  const double s = t / spec.legTime - static_cast<double>(leg);
  place = from + s * s * s * (10. - 15. * s + 6. * s * s) * way;
  velocity = 30. * s * s * (1. - s) * (1. - s) / spec.legTime * way;
}

void evaluate(vpSelfMotionRun &run)
{
  run.start_distance_m = run.samples.front().distance;
  run.end_distance_m = run.samples.back().distance;
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const vpSelfMotionSample &s = run.samples[i];
    run.tcp_drift_m = std::max(run.tcp_drift_m, s.drift);
    run.tcp_drift_rad = std::max(run.tcp_drift_rad, s.turn);
    run.mean_distance_m += s.distance / static_cast<double>(run.samples.size());
    run.joint_travel_rad += i > 0 ? (s.q - run.samples[i - 1].q).cwiseAbs().sum() : 0.;
  }
}
} // namespace

vpSelfMotionRunSpec vpSelfMotionRunSpec::thesis(const std::shared_ptr<const vpArmModel> &arm)
{
  vpSelfMotionRunSpec spec;
  spec.arm = arm;
  spec.start = arm->home();
  vpArmData data;
  vpArmKinematics::forward(*arm, spec.start, data);
  for (const Eigen::Vector3d &way :
       {Eigen::Vector3d(0.05, 0.07, 0.), Eigen::Vector3d(-0.05, 0.12, 0.), Eigen::Vector3d(0., 0.17, 0.)}) {
    spec.places.push_back(data.tool.p + way);
  }
  return spec;
}

vpSelfMotionIndex vpSelfMotionRunSpec::thesisPlane(const vpArmModel &arm, vpIndexSense sense)
{
  constexpr int joint = 3;
  const Eigen::Vector3d base(0., 0., 0.), above(0., 0., 1.), third(1., 1., 0.5);
  const Eigen::Vector3d normal = (above - base).cross(third - base);
  vpArmData data;
  vpArmKinematics::forward(arm, arm.home(), data);
  const double side = normal.dot(data.joint[joint].p - base) < 0. ? -1. : 1.;
  return vpSelfMotionIndex::planeDistance(joint, base, side * normal, sense);
}

void vpSelfMotionRunSpec::validate() const
{
  if (!arm) {
    throw vpException(vpException::badValue, "the self-motion experiment has no arm");
  }
  if (start.size() != arm->size() || !start.allFinite()) {
    throw vpException(vpException::badValue,
                      "the start of the self-motion experiment has %d numbers, must have %d "
                      "finite ones",
                      static_cast<int>(start.size()), arm->size());
  }
  for (const Eigen::Vector3d &place : places) {
    for (const double value : {place.x(), place.y(), place.z()}) {
      fields.finite("a place", value);
    }
  }
  fields.positive("legTime", legTime, "s");
  fields.notNegative("restTime", restTime, "s");
  fields.in("share", share, {0., 1.});
  index.validate(*arm);
}

vpSelfMotionRun runSelfMotionExperiment(const vpSelfMotionRunSpec &spec)
{
  spec.validate();
  vpRedundancySpec redundancy;
  redundancy.period = period;
  redundancy.selfMotion = spec.share;
  vpClosedLoopKinematics loop(*spec.arm, redundancy);
  vpClosedLoopState state;
  state.q = spec.start;
  vpClosedLoopInput input;
  input.indices[0] = spec.index;
  input.indexCount = 1;
  vpClosedLoopOutput output;
  vpArmData data;
  vpArmKinematics::update(*spec.arm, spec.start, data);
  const vpRigidTransform start = data.tool;

  vpSelfMotionRun run;
  const double duration = static_cast<double>(spec.places.size()) * spec.legTime + spec.restTime;
  const long cycles = std::lround(duration / period);
  for (long k = 0; k <= cycles; ++k) {
    vpSelfMotionSample s;
    s.time = static_cast<double>(k) * period;
    s.q = state.q;
    Eigen::Vector3d place, velocity;
    reference(spec, start.p, s.time, place, velocity);
    vpArmKinematics::update(*spec.arm, state.q, data);
    s.drift = (data.tool.p - place).norm();
    s.turn = vpSO3::log(start.R.transpose() * data.tool.R).norm();
    vpIndexValue value;
    static_cast<void>(vpEvaluateIndex(*spec.arm, data, spec.index, value));
    s.distance = value.distance;
    run.samples.push_back(s);

    // The goal is the desired tool position now; the velocity is the mean until the next period.
    Eigen::Vector3d next;
    reference(spec, start.p, s.time + period, next, velocity);
    const Eigen::Vector3d mean = (next - place) / period;
    input.goal = {start.R, place};
    input.twist = vpTwist(mean.x(), mean.y(), mean.z(), 0., 0., 0.);
    loop.step(input, state, output);
  }
  evaluate(run);
  return run;
}

END_VISP_NAMESPACE
