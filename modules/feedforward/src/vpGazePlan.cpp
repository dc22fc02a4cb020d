/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpGazePlan.h"

#include "vpFeedforwardErrors.h"

#include <visp3/direct_core/vpSO3.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <tuple>

BEGIN_VISP_NAMESPACE

namespace
{
using P = vpTrajectoryProblem;

// Step of the central difference that gives e'' at the start, s.
constexpr double differenceStep = 1e-4;

// w = R^T (rate of R_la) + J_r(e) e', R_la turning by d' = -t'.
Eigen::Vector3d gazeRate(const vpLookAt &lookAt, const Eigen::Vector3d &velocity)
{
  return lookAt.rotation.transpose() * (lookAt.rate * -velocity);
}
} // namespace

vpGazePlan::vpGazePlan()
  : m_problems{vpTrajectoryProblem(3), vpTrajectoryProblem(3)},
    m_planner(3), m_plans{vpTrajectoryPlan(3), vpTrajectoryPlan(3)}
{
  forgetNorms();
}

// e and e' when the twist continues with its rate.
vpGazePlan::Rest vpGazePlan::restAt(const Start &start, double time) const noexcept
{
  const vpServoPose::Pose now = vpServoPose::moved(start.pose, (start.twist + 0.5 * time * start.rate).head<3>(),
                                                   (start.twist + 0.5 * time * start.rate).tail<3>(), time);
  const Vector6 twist = start.twist + time * start.rate;
  Rest rest;
  rest.e = vpSO3::log(now.R);
  Eigen::Vector3d w = twist.tail<3>();
  if (m_gaze) {
    const vpLookAt lookAt(m_origin, now.t);
    rest.e = vpSO3::log(lookAt.rotation.transpose() * now.R);
    w -= vpSO3::exp(rest.e).transpose() * gazeRate(lookAt, now.R * twist.head<3>());
  }
  rest.rate = vpSO3::rightJacobianInverse(rest.e) * w;
  return rest;
}

bool vpGazePlan::coordinates(const Start &start, Axes &axes) const noexcept
{
  if (m_gaze && !vpLookAt(m_origin, start.pose.t).defined) {
    return false;
  }
  const Eigen::Vector3d v = start.twist.head<3>(), w = start.twist.tail<3>();
  const Eigen::Vector3d velocity = start.pose.R * v, acceleration = start.pose.R * (start.rate.head<3>() + w.cross(v));
  const Rest now = restAt(start, 0.);
  const Eigen::Vector3d second =
      (restAt(start, differenceStep).rate - restAt(start, -differenceStep).rate) / (2. * differenceStep);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    axes[Position][k] = {start.pose.t[i], velocity[i], acceleration[i], 0.};
    axes[Orientation][k] = {now.e[i], now.rate[i], second[i], 0.};
  }
  return true;
}

bool vpGazePlan::set(const Start &start, const Eigen::Vector3d &origin, bool gaze,
                     const vpServoMotionLimits &limits) noexcept
{
  m_origin = origin;
  m_gaze = gaze;
  m_since = m_correctionTime = 0.;
  Axes axes;
  if (!coordinates(start, axes)) {
    return false;
  }
  const vpTwistNorms norms = vpTwistExcess::normsOf(limits);
  bool isGood = true;
  for (const Part part : {Position, Orientation}) {
    vpTrajectoryProblem &problem = m_problems[part];
    const double *limit = norms.data() + 3 * part;
    for (int i = 0; i < 3; ++i) {
      problem.setStart(i, axes[part][static_cast<std::size_t>(i)]);
      problem.field(P::MaxVelocity)[i] = limit[0];
      problem.field(P::MaxAcceleration)[i] = limit[1];
      problem.field(P::MaxJerk)[i] = limit[2];
    }
    problem.spec.groups[0] = vpAxisGroup({0, 1, 2}, limit[0], limit[1]);
    isGood = problem.validate(true).isGood() && isGood;
  }
  return isGood;
}

bool vpGazePlan::correct(const vpGazePlan &base, double since, const Start &start, double duration) noexcept
{
  m_origin = base.m_origin;
  m_gaze = base.m_gaze;
  m_plans = base.m_plans; // of equal size: no allocation
  m_since = base.m_since + since;
  m_correctionTime = duration;
  Axes axes;
  if (!coordinates(start, axes)) {
    return false;
  }
  for (const Part part : {Position, Orientation}) {
    for (int i = 0; i < 3; ++i) {
      vpAxisState &off = axes[part][static_cast<std::size_t>(i)];
      const vpAxisState plan = m_plans[part].at(i, m_since);
      std::transform(off.begin(), off.end(), plan.begin(), off.begin(), std::minus<>());
      vpPolynomial &quintic = m_corrections[part][static_cast<std::size_t>(i)];
      const vpAxisState back = {-off[0], 0., 0., 0.};
      quintic = vpMotionFamily::pointToPoint({0., off[1], off[2], 0.}, back, 3).at(duration);
      quintic[0] += off[0];
    }
  }
  return true;
}

// Of an axis: value and rate.
std::pair<double, double> vpGazePlan::at(Part part, int axis, double time) const noexcept
{
  const vpAxisState plan = m_plans[part].at(axis, m_since + time);
  if (!(time < m_correctionTime)) {
    return {plan[0], plan[1]};
  }
  const auto off = m_corrections[part][static_cast<std::size_t>(axis)].jet(time / m_correctionTime);
  return {plan[0] + off[0], plan[1] + off[1] / m_correctionTime};
}

void vpGazePlan::slowDown(double factor) noexcept
{
  for (vpTrajectoryProblem &problem : m_problems) {
    for (int i = 0; i < 3; ++i) {
      problem.field(P::MaxVelocity)[i] /= factor;
      problem.field(P::MaxAcceleration)[i] /= factor * factor;
      problem.field(P::MaxJerk)[i] /= factor * factor * factor;
    }
    problem.spec.groups[0].maxSpeed /= factor;
    problem.spec.groups[0].maxAcceleration /= factor * factor;
  }
}

void vpGazePlan::soften(Part part, double factor) noexcept
{
  for (int i = 0; i < 3; ++i) {
    m_problems[part].field(P::MaxJerk)[i] /= factor;
  }
}

double vpGazePlan::plan(Part part, double floor) noexcept
{
  vpTrajectoryPlan &plan = m_plans[part];
  const bool isGood = m_planner.plan(m_problems[part], floor, plan).isGood() && plan.isFinite();
  return isGood ? plan.duration() : std::numeric_limits<double>::quiet_NaN();
}

vpGazePlan::Vector6 vpGazePlan::twist(double time) const noexcept
{
  Vector6 twist = Vector6::Zero();
  if (time >= duration()) {
    return twist;
  }
  Eigen::Vector3d t, velocity, e, rate;
  for (int i = 0; i < 3; ++i) {
    std::tie(t[i], velocity[i]) = at(Position, i, time);
    std::tie(e[i], rate[i]) = at(Orientation, i, time);
  }
  Eigen::Matrix3d R = vpSO3::exp(e);
  twist.tail<3>() = vpSO3::rightJacobian(e) * rate;
  if (m_gaze) {
    const vpLookAt lookAt(m_origin, t);
    twist.tail<3>() += R.transpose() * gazeRate(lookAt, velocity);
    R = lookAt.rotation * R;
  }
  twist.head<3>() = R.transpose() * velocity;
  return twist;
}

std::size_t vpGazePlan::binOf(double time) const noexcept
{
  return static_cast<std::size_t>(std::clamp(time / (duration() + tail) * bins, 0., bins - 1.));
}

void vpGazePlan::noteNorms(double end, const vpTwistNorms &norms) noexcept
{
  vpTwistNorms &bin = m_norms[binOf(end)];
  bin = bin.max(norms);
}

void vpGazePlan::finishNorms() noexcept
{
  for (std::size_t i = bins - 1; i-- > 0;) {
    m_norms[i] = m_norms[i].max(m_norms[i + 1]);
  }
}

vpTwistNorms vpGazePlan::normsFrom(double time) const noexcept
{
  return time < duration() + tail ? m_norms[binOf(time)] : vpTwistNorms(vpTwistNorms::Zero());
}

END_VISP_NAMESPACE
