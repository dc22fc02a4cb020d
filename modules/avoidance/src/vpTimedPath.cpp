/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpTimedPath.h>

#include "vpFieldCheck.h"

#include <visp3/core/vpException.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the timed path");
using Input = vpTrajectoryInput<Eigen::Dynamic>;
constexpr double sampleTime = 0.005; // s, for the bounds of the tool
constexpr double reserve = 0.99;     // fraction of these bounds used

void requireSize(const char *field, const vpJointVector &value, int n)
{
  if (value.size() != 0 && (value.size() != n || !value.allFinite())) {
    throw vpException(vpException::badValue,
                      "%s at the start of the timed path has %d numbers, must have %d finite ones", field,
                      static_cast<int>(value.size()), n);
  }
}

bool isMoving(const vpJointVector &rate) { return rate.size() != 0 && rate.cwiseAbs().maxCoeff() > 0.; }

//! Factor by which time must be stretched for the tool to keep its bounds; at most 1: they are kept.
double stretchForTool(const vpArmModel &arm, const vpTrajectoryPlan &plan, const vpTimedPathSpec &spec)
{
  vpArmData data;
  vpJointVector q(arm.size()), v(arm.size());
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  double stretch = 0.;
  for (double t = 0.; t <= plan.duration(); t += sampleTime) {
    for (int j = 0; j < arm.size(); ++j) {
      const vpAxisState x = plan.at(j, t);
      q(j) = x[0];
      v(j) = x[1];
    }
    vpArmKinematics::update(arm, q, data);
    const Eigen::Vector3d velocity = data.J.topRows<3>() * v;
    stretch = std::max(stretch, velocity.norm() / (reserve * spec.toolVelocity));
    if (t > 0.) {
      const double acceleration = (velocity - before).norm() / sampleTime;
      stretch = std::max(stretch, std::sqrt(acceleration / (reserve * spec.toolAcceleration)));
    }
    before = velocity;
  }
  return stretch;
}

//! The fastest motion that keeps the tool's bounds. False: there is none, or none was found.
vpTrajectoryStatus planWithinBounds(const vpArmModel &arm, Input &input, const vpTimedPathSpec &spec,
                                    vpTrajectoryPlan &plan)
{
  constexpr int attempts = 6; // from rest the second one succeeds; a start velocity prevents proportional scaling
  vpTrajectoryStatus status = vpDirectTrajectory<Eigen::Dynamic>::calculate(input, plan);
  if (std::isinf(spec.toolVelocity) && std::isinf(spec.toolAcceleration)) {
    return status;
  }
  for (int attempt = 0; status.isGood(); ++attempt) {
    const double stretch = stretchForTool(arm, plan, spec);
    if (stretch <= 1.) {
      return status;
    }
    if (attempt == attempts) {
      status.result = vpTrajectoryResult::NoFeasibleDuration;
      return status;
    }
    if (isMoving(input.start.v) || isMoving(input.start.a)) {
      input.maxVelocity /= 1.001 * stretch;
      input.maxAcceleration /= 1.001 * stretch * stretch;
    }
    else {
      input.spec.minimumDuration = 1.001 * stretch * plan.duration();
    }
    status = vpDirectTrajectory<Eigen::Dynamic>::calculate(input, plan);
  }
  return status;
}

//! Points first..last of a path as one motion to rest, from rest except at the path's start.
Input inputOf(const vpArmModel &arm, const vpJointPath &path, std::size_t first, std::size_t last,
              const vpTimedPathSpec &spec)
{
  Input input(arm.size());
  input.start.q = path.points[first];
  input.goal.q = path.points[last];
  input.maxVelocity = spec.speed * arm.velocity();
  input.maxAcceleration = spec.acceleration * arm.acceleration();
  input.minPosition = arm.lower();
  input.maxPosition = arm.upper();
  input.spec.cruise = false; // the same shape for every duration, so that stretching it stretches the tool's motion
  input.spec.synchronisation = last <= first + 1 ? vpSynchronisation::Straight : vpSynchronisation::Time;
  if (first == 0 && spec.startVelocity.size() != 0) {
    input.start.v = spec.startVelocity;
  }
  if (first == 0 && spec.startAcceleration.size() != 0) {
    input.start.a = spec.startAcceleration;
  }
  double length = 0., way = 0.;
  for (std::size_t i = first; i < last; ++i) {
    length += (path.points[i + 1] - path.points[i]).norm();
  }
  for (std::size_t i = first + 1; i < last; ++i) {
    way += (path.points[i] - path.points[i - 1]).norm();
    vpTrajectoryVia<Eigen::Dynamic> via(arm.size());
    via.tau = way / length;
    via.q = path.points[i];
    input.vias.push_back(via);
  }
  return input;
}

//! The path without duplicate consecutive points.
vpJointPath withoutRepeats(const vpJointPath &path)
{
  vpJointPath result;
  for (const vpJointVector &q : path.points) {
    if (result.points.empty() || (q - result.points.back()).norm() > 1e-9) {
      result.points.push_back(q);
    }
  }
  return result;
}
} // namespace

vpTimedPath::vpTimedPath(const vpCollisionScene &scene, const vpJointPath &path, const vpTimedPathSpec &spec)
{
  vpCertifiedTrajectory certificate(scene, {spec.margin, spec.resolution});
  build(scene, path, spec, certificate);
}

vpTimedPath::vpTimedPath(const vpCollisionScene &scene, const vpJointPath &path, const vpTimedPathSpec &spec,
                         vpCertifiedTrajectory &certificate)
{
  certificate.setMargin(spec.margin);
  build(scene, path, spec, certificate);
}

void vpTimedPath::build(const vpCollisionScene &scene, const vpJointPath &path, const vpTimedPathSpec &spec,
                        vpCertifiedTrajectory &certificate)
{
  const vpArmModel &arm = scene.arm();
  fields.in("speed", spec.speed, vpFieldRange::positive(1.));
  fields.in("acceleration", spec.acceleration, vpFieldRange::positive(1.));
  fields.require(spec.toolVelocity > 0., "toolVelocity", spec.toolVelocity, "> 0");
  fields.require(spec.toolAcceleration > 0., "toolAcceleration", spec.toolAcceleration, "> 0");
  requireSize("velocity", spec.startVelocity, arm.size());
  requireSize("acceleration", spec.startAcceleration, arm.size());
  arm.requireMotionLimits("a timed path");
  if (path.points.empty()) {
    throw vpException(vpException::badValue, "the path to be timed has no points");
  }
  for (const vpJointVector &q : path.points) {
    if (q.size() != arm.size() || !(q.cwiseAbs().array() <= vpLargestCoordinate).all()) {
      throw vpException(vpException::badValue,
                        "a point of the path to be timed has %d numbers, must have %d finite ones",
                        static_cast<int>(q.size()), arm.size());
    }
  }
  m_start = path.points.front();
  m_worst.status = vpMotionStatus::Free;
  const vpJointPath way = withoutRepeats(path);
  // Pending sections, the next one last.
  std::vector<std::pair<std::size_t, std::size_t>> open;
  const bool moving = isMoving(spec.startVelocity) || isMoving(spec.startAcceleration);
  if (way.points.size() > 1 || moving) {
    open.emplace_back(0, way.points.size() - 1);
  }
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    Input input = inputOf(arm, way, first, last, spec);
    vpTrajectoryPlan plan(arm.size());
    const vpTrajectoryStatus status = planWithinBounds(arm, input, spec, plan);
    const bool single = last <= first + 1;
    if (!status.isGood() && single && moving && first == 0) {
      m_worst = vpTrajectoryClearance();
      return;
    }
    if (!status.isGood() && single) {
      throw vpException(vpException::badValue, "the path cannot be timed: %s", status.message().c_str());
    }
    const vpTrajectoryClearance clearance =
        status.isGood() ? certificate.check(plan, 0., plan.duration(), m_duration) : vpTrajectoryClearance();
    if (single || clearance.isFree()) {
      append(plan, clearance);
      continue;
    }
    const std::size_t middle = (first + last) / 2;
    open.emplace_back(middle, last);
    open.emplace_back(first, middle);
  }
}

void vpTimedPath::append(const vpTrajectoryPlan &plan, const vpTrajectoryClearance &clearance)
{
  if (m_worst.isFree()) {
    m_worst = clearance;
    m_worst.time += m_duration;
  }
  m_parts.push_back({m_duration, plan});
  m_duration += plan.duration();
}

vpAxisState vpTimedPath::at(int joint, double t) const noexcept
{
  t = t > 0. ? std::min(t, m_duration) : 0.; // NaN: the start
  const auto next = std::upper_bound(m_parts.begin(), m_parts.end(), t,
                                     [](double time, const Part &part) { return time < part.begin; });
  if (m_parts.empty()) {
    return {m_start(joint), 0., 0., 0.};
  }
  const Part &part = next == m_parts.begin() ? *next : *(next - 1);
  return part.plan.at(joint, t - part.begin);
}

std::string vpTimedPath::message(const vpCollisionScene &scene) const
{
  char text[128];
  if (!isFree()) {
    std::snprintf(text, sizeof(text), "Not free after %.2f s: ", m_worst.time);
    return text + scene.describe(m_worst.pair) + ".";
  }
  const int rests = std::max(0, static_cast<int>(m_parts.size()) - 1);
  std::snprintf(text, sizeof(text), "Free, %.2f s, %d %s on the way.", m_duration, rests,
                rests == 1 ? "rest" : "rests");
  return text;
}

END_VISP_NAMESPACE
