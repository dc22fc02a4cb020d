/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpRedundancyCycle.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
void check(const vpArmModel &model, bool good, const char *field, double value, const char *range)
{
  if (!good) {
    throw vpException(vpException::badValue, "%s of the redundancy solver for %s is %g, must be %s", field,
                      model.label().c_str(), value, range);
  }
}

// Sentence about the first of the axes.
const char *unreachable(unsigned int axes)
{
  static constexpr const char *sentences[] = {
      "Translation along x cannot be commanded in this configuration: the arm has too few joints for the task.",
      "Translation along y cannot be commanded in this configuration: the arm has too few joints for the task.",
      "Translation along z cannot be commanded in this configuration: the arm has too few joints for the task.",
      "Rotation about x cannot be commanded in this configuration: the arm has too few joints for the task.",
      "Rotation about y cannot be commanded in this configuration: the arm has too few joints for the task.",
      "Rotation about z cannot be commanded in this configuration: the arm has too few joints for the task."};
  for (int k = 0; k < 6; ++k) {
    if ((axes >> k & 1U) != 0U) {
      return sentences[k];
    }
  }
  return "The arm has too few joints for the task.";
}

bool isPlausible(const vpTwist &twist)
{
  for (std::size_t i = 0; i < 6; ++i) {
    if (!(std::fabs(twist[i]) <= vpArmLargest)) {
      return false;
    }
  }
  return true;
}

bool usable(const vpArmModel &model, const vpArmData &data, const vpRedundancyInput &input)
{
  const int n = model.size();
  if (data.size != n || data.J.cols() != n || data.q.size() != n || input.previous.size() != n ||
      !vpIsPlausibleForArm(input.previous) || !vpIsPlausibleForArm(data.J) || !vpIsPlausibleForArm(data.q) ||
      !isPlausible(input.twist) || input.taskCount < 0 || input.taskCount > vpMaxArmTasks || input.indexCount < 0 ||
      input.indexCount > vpMaxArmIndices || !(input.selfMotionShare >= 0. && input.selfMotionShare <= 1.)) {
    return false;
  }
  for (int t = 0; t < input.taskCount; ++t) {
    const vpArmTask &task = input.tasks[static_cast<std::size_t>(t)];
    if (task.rows < 0 || task.rows > 6 || task.J.cols() != n || !vpIsPlausibleForArm(task.velocity.head(task.rows)) ||
        !vpIsPlausibleForArm(task.J.topRows(task.rows))) {
      return false;
    }
  }
  return true;
}
} // namespace

void vpRedundancySpec::validate(const vpArmModel &model) const
{
  const auto positive = [&model](const char *field, double value) {
    check(model, value >= 1e-12 && value <= vpArmLargest, field, value, "> 0 and finite (1e-12 to 1e9)");
  };
  const auto notNegative = [&model](const char *field, double value) {
    check(model, value >= 0. && value <= vpArmLargest, field, value, ">= 0 and finite (at most 1e9)");
  };
  positive("period", period);
  positive("taskLength", taskLength);
  positive("singularRegion", singularRegion);
  positive("damping", damping);
  positive("escapeDemand", escapeDemand);
  positive("softGradient", softGradient);
  notNegative("escapeSpeed", escapeSpeed);
  notNegative("minSelfMotion", minSelfMotion);
  notNegative("positionMargin", positionMargin);
  check(model, selfAcceleration >= 0. && selfAcceleration <= 1., "selfAcceleration", selfAcceleration, "in [0, 1]");
  check(model, selfMotion >= 0. && selfMotion <= 1., "selfMotion", selfMotion, "in [0, 1]");
  check(model, weights.size() == 0 || weights.size() == model.size(), "number of weights",
        static_cast<double>(weights.size()), "0 or the number of joints");
  for (int i = 0; i < weights.size(); ++i) {
    positive("weight", weights(i));
  }
  for (int i = 0; i < model.size(); ++i) {
    check(model, model.upper()(i) - model.lower()(i) > 2. * positionMargin, "positionMargin", positionMargin,
          "less than half the range of every joint");
  }
}

vpArmTask vpArmTask::pointVelocity(const vpArmModel &model, const vpArmData &data, int joint,
                                   const Eigen::Vector3d &velocity) noexcept
{
  vpArmTask task;
  task.rows = 3;
  task.J.setZero(6, model.size());
  task.J.topRows<3>() = vpArmKinematics::pointJacobian(model, data, joint);
  task.velocity.head<3>() = velocity;
  return task;
}

const char *vpRedundancyOutput::message() const noexcept
{
  switch (status) {
  case vpRedundancyStatus::Exact:
    return "The arm moves as wanted.";
  case vpRedundancyStatus::Accelerating:
    return "The arm is on the way to the wanted velocity, at an acceleration limit.";
  case vpRedundancyStatus::Scaled:
    return "The arm is slower than wanted because a joint is at its limit.";
  case vpRedundancyStatus::Damped:
    return "The arm is near a singularity and slower than wanted in the direction it is losing.";
  case vpRedundancyStatus::Escaping:
    return "The arm is near a singularity and leaves it by self-motion.";
  case vpRedundancyStatus::JointsStopped:
    return "Joints are held at their position limits and the others do not make up for all of it.";
  case vpRedundancyStatus::BlockedByLimits:
    return "The wanted motion is impossible because joints are at their position limits.";
  case vpRedundancyStatus::BlockedBySingularity:
    return "The wanted motion is impossible in this pose: the arm is singular and the motion leads out of its "
           "workspace.";
  case vpRedundancyStatus::AxisUnreachable:
    return unreachable(unreachableAxes);
  case vpRedundancyStatus::InvalidInput:
    return "An input is not finite, beyond 1e9 or of a wrong size; the arm brakes.";
  }
  return "";
}

vpRedundancySolver::vpRedundancySolver(const vpArmModel &model, const vpRedundancySpec &spec)
  : m_model(&model), m_spec(spec), m_lacking(vpLackingAxes(model))
{
  model.requireMotionLimits("the redundancy solver");
  spec.validate(model);
  m_scale.setZero();
  for (int i = 0; i < model.size(); ++i) {
    m_scale(i) = spec.weights.size() == 0 ? 1. : 1. / std::sqrt(spec.weights(i));
  }
}

// Without using data that may be invalid.
void vpRedundancySolver::brake(const vpRedundancyInput &input, vpRedundancyOutput &output) const noexcept
{
  const int n = m_model->size();
  output.selfMotion.setZero(n);
  output.velocity.setZero(n);
  for (int i = 0; i < n && input.previous.size() == n; ++i) {
    const double v = input.previous(i), step = m_spec.period * m_model->acceleration()(i);
    const double speed = std::min(std::fabs(v), m_model->velocity()(i));
    output.velocity(i) = std::fabs(v) <= vpArmLargest ? std::copysign(std::max(0., speed - step), v) : 0.;
  }
  output.scale = 1.;
  output.status = vpRedundancyStatus::InvalidInput;
}

void vpRedundancySolver::step(const vpArmData &data, const vpRedundancyInput &input,
                              vpRedundancyOutput &output) const noexcept
{
  const int n = m_model->size();
  output.selfMotion.setZero(n);
  output.stoppedJoints = output.saturatedJoints = output.unreachableAxes = 0;
  output.taskShare = 0.;
  output.scale = 1.;
  output.smallestSingular = 0.;
  if (!usable(*m_model, data, input)) {
    brake(input, output);
    return;
  }

  // A small capacity makes common arms faster.
  const bool done =
      n <= 8 ? vpRedundancyCycle<8>(*m_model, m_spec, m_scale.head<8>(), m_lacking, data, input).run(output)
             : vpRedundancyCycle<vpArmMaxJoints>(*m_model, m_spec, m_scale, m_lacking, data, input).run(output);
  if (!done) {
    brake(input, output);
  }
}

END_VISP_NAMESPACE
